// Keeps Vulkan drivers loaded for the whole program: otherwise each test in which a runtime chooses a backend would
// load and unload all drivers again.

#include "backend/vulkan/instance.h"
#include "vulkan/keep_libraries.h"

namespace {

[[maybe_unused]] const bool drivers_stay = [] {
  // Vulkan drivers stay loaded as long as an instance exists.
  const auto instance = sgm::vulkan::Instance::create();
  if (instance) sgm::vulkan::keepLibraries();
  return static_cast<bool>(instance);
}();

}  // namespace

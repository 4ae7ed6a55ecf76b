// Keeps Vulkan drivers loaded: tests in which a runtime chooses a backend would otherwise load and unload all drivers
// again.

#include "backend/vulkan/instance.h"
#include "vulkan/keep_libraries.h"

namespace {

[[maybe_unused]] const bool drivers_stay = [] {
  // Drivers are loaded as long as there is an instance.
  const auto instance = sgm::vulkan::Instance::create();
  if (instance) sgm::vulkan::keepLibraries();
  return static_cast<bool>(instance);
}();

}  // namespace

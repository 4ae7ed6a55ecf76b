// A libcuda.so.1 for programs under test: the simulated driver (fake_gpu.h). If SGM_PRETEND_VULKAN is set in the
// environment, its GPU has the id of Vulkan's first device.

#include <cstdlib>

#include "fake_gpu.h"
#ifdef SGM_PRETENDS_VULKAN
#include "backend/vulkan/devices.h"
#endif

namespace {

#ifdef SGM_PRETENDS_VULKAN
void becomeVulkan() {
  if (std::getenv("SGM_PRETEND_VULKAN") == nullptr) return;
  const auto devices = sgm::vulkan::listDevices();
  if (devices && !devices->empty()) sgm::cuda::fakeState().id = devices->front().id;
}
#else
void becomeVulkan() {}
#endif

sgm::cuda::DriverTable makeTable() {
  sgm::cuda::DriverTable made = sgm::cuda::fakeTable();
  made.init = [](unsigned flags) {
    becomeVulkan();
    return sgm::cuda::fakeTable().init(flags);
  };
  return made;
}

const sgm::cuda::DriverTable table = makeTable();

}  // namespace

// For each name, defines an exported function that jumps to the function in the table, so that parameters of any type
// are passed on unchanged.
#define SGM_CU(entry, name, parameters)                                       \
  extern "C" __attribute__((visibility("hidden"))) void* sgm_fake_##entry;    \
  void* sgm_fake_##entry = reinterpret_cast<void*>(table.entry);              \
  asm(".pushsection .text\n.globl " name "\n.type " name ", @function\n" name \
      ":\n"                                                                   \
      "jmp *sgm_fake_" #entry "(%rip)\n.popsection\n");
SGM_CU_FUNCTIONS
#undef SGM_CU

/// The state of the simulated GPU, for a program's tests.
extern "C" __attribute__((visibility("default"))) sgm::cuda::FakeState* sgm_fake_state();
extern "C" sgm::cuda::FakeState* sgm_fake_state() { return &sgm::cuda::fakeState(); }

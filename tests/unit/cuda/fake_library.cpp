// libcuda.so.1, as a program finds it: the driver that pretends (fake_gpu.h). With SGM_PRETEND_VULKAN in the
// environment its GPU is the first of Vulkan's devices.

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

// A function of each name that jumps to the table's: their parameters, whatever they are, stay where they are.
#define SGM_CU(entry, name, parameters)                                       \
  extern "C" __attribute__((visibility("hidden"))) void* sgm_fake_##entry;    \
  void* sgm_fake_##entry = reinterpret_cast<void*>(table.entry);              \
  asm(".pushsection .text\n.globl " name "\n.type " name ", @function\n" name \
      ":\n"                                                                   \
      "jmp *sgm_fake_" #entry "(%rip)\n.popsection\n");
SGM_CU_FUNCTIONS
#undef SGM_CU

/// What a program's tests look at.
extern "C" __attribute__((visibility("default"))) sgm::cuda::FakeState* sgm_fake_state();
extern "C" sgm::cuda::FakeState* sgm_fake_state() { return &sgm::cuda::fakeState(); }

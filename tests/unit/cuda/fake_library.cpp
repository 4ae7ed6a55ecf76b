// libcuda.so.1, as a program finds it: the driver that pretends (fake_gpu.h).

#include "fake_gpu.h"

namespace {

const sgm::cuda::DriverTable table = sgm::cuda::fakeTable();

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

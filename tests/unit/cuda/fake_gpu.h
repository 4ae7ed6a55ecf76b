#pragma once
// A simulated CUDA driver: its GPU's memory is host memory, its kernels run on the CPU (host_device.h), and it counts
// the objects that it has created. Only one simulation may exist at a time, because the functions of a driver are not
// members of an object. Any thread may call these functions.

#include <array>
#include <cstdint>
#include <string>

#include "cuda/driver_api.h"

namespace sgm::cuda {

/// Properties of the simulated GPU, counts of its live objects, and the fault to simulate.
struct FakeState {
  int devices = 1, capability_major = 9, capability_minor = 0, memory_pools = 1;
  int contexts = 0, modules = 0, pools = 0, streams = 0, events = 0;  ///< numbers of live objects
  int64_t device_blocks = 0, pinned_blocks = 0;
  int imports = 0, mapped = 0;  ///< numbers of live imports of other APIs' memory, and of those that are mapped
  std::array<unsigned char, 16> id = {'p', 'r', 'e', 't', 'e', 'n', 'd', 's'};
  int calls_without = 0;  ///< number of calls that need a current context but had none
  uint64_t launches = 0;
  CuStream launched_on = nullptr;  ///< stream of the last launch
  // From now on, the fail_nth-th call of fail_call returns fail_result; if `lasts`, all later calls of it do so, too.
  std::string fail_call;
  unsigned fail_nth = 0;
  int fail_result = 0;
  bool lasts = false;
  bool may_leave = false;  ///< set after a fatal error: objects may remain in a context that cannot be used any more
  /// Set after a fatal error or a failed wait: it is then unknown whether the GPU still uses memory
  bool unsure = false;
};

FakeState& fakeState();
int fakeDepth();  ///< number of contexts in this thread's stack of current contexts
DriverTable fakeTable();
/// Creates the simulated GPU, which exists until endFake(). Its id is always the same.
void beginFake();
/// Destroys the simulated GPU, and frees all objects that were left.
void endFake();

}  // namespace sgm::cuda

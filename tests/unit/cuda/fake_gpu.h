#pragma once
// A CUDA driver that pretends: its GPU's memory is the host's, its kernels run here (host_device.h), and it keeps count
// of what it has given out. One at a time, as a driver's functions have no object; any
// thread may call them.

#include <array>
#include <cstdint>
#include <string>

#include "cuda/driver_api.h"

namespace sgm::cuda {

/// What it is, what it has given out, and what it is to fail at.
struct FakeState {
  int devices = 1, capability_major = 9, capability_minor = 0, memory_pools = 1;
  int contexts = 0, modules = 0, pools = 0, streams = 0, events = 0;  ///< alive
  int64_t device_blocks = 0, pinned_blocks = 0;
  int imports = 0, mapped = 0;  ///< of other APIs' memory, alive; and so many of them in reach
  std::array<unsigned char, 16> id = {'p', 'r', 'e', 't', 'e', 'n', 'd', 's'};
  int calls_without = 0;  ///< that need a current context, and had none
  uint64_t launches = 0;
  CuStream launched_on = nullptr;  ///< the last of them
  // The nth call of that name from now on gives this result, and where it is one that lasts all after it do.
  std::string fail_call;
  unsigned fail_nth = 0;
  int fail_result = 0;
  bool lasts = false;
  bool may_leave = false;  ///< things in a context that cannot be used any more
  bool unsure = false;     ///< something has failed for good, or a wait: nobody could say whether memory was in use
};

FakeState& fakeState();
int fakeDepth();  ///< contexts that are current on this thread
DriverTable fakeTable();
/// Between these two there is a GPU, which keeps the id of the last one.
void beginFake();
/// Frees what was left behind.
void endFake();

}  // namespace sgm::cuda

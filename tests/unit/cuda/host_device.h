#pragma once
// The kernels on the CPU, block by block, thread after thread: what a GPU does, on a machine without one. For tests,
// not for speed.

#include <functional>
#include <optional>

#include "cuda/device.h"

namespace sgm::cuda {

struct HostDeviceOptions {
  /// Blocks of a launch, and threads of a phase, run in an order shuffled by this: none may matter. None: ascending.
  std::optional<uint32_t> shuffled;
  /// Called before every call that can fail, with its name ("allocate", "launch"...); an error is its result.
  std::function<Result<void>(const char* call)> before = nullptr;
  bool borrowed = false;  ///< as if an engine had lent it
};

/// New memory holds bytes that no kernel can take for anything.
std::unique_ptr<Device> makeHostDevice(HostDeviceOptions options = {});

}  // namespace sgm::cuda

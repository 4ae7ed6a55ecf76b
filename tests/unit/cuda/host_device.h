#pragma once
// Runs the CUDA kernels on the CPU, block by block and thread by thread, as a GPU would, on a machine without one. For
// tests, not for speed.

#include <functional>
#include <optional>

#include "cuda/device.h"

namespace sgm::cuda {

struct HostDeviceOptions {
  /// Seed by which the order of a launch's blocks, and of the threads in each phase, is shuffled: the order must not
  /// matter. nullopt: ascending order.
  std::optional<uint32_t> shuffled;
  /// Called before every call that can fail, with the call's name ("allocate", "launch"...). If it returns an error,
  /// the call fails with that error.
  std::function<Result<void>(const char* call)> before = nullptr;
  bool borrowed = false;  ///< whether the device behaves like one that an engine provides
};

/// Makes a device. New memory contains byte patterns that no kernel can mistake for valid data.
std::unique_ptr<Device> makeHostDevice(HostDeviceOptions options = {});

}  // namespace sgm::cuda

#pragma once
// Runs the CUDA kernels on the CPU, block by block and thread by thread, in the way that a GPU runs them. For tests on
// machines without a GPU, not for speed.

#include <functional>
#include <optional>

#include "cuda/device.h"

namespace sgm::cuda {

struct HostDeviceOptions {
  /// Seed that shuffles the order in which the blocks of a launch run, and the threads in each phase: results must not
  /// depend on this order. nullopt: ascending order.
  std::optional<uint32_t> shuffled;
  /// Called before every call that can fail, with the call's name ("allocate", "launch"...). If it returns an error,
  /// the call fails with that error.
  std::function<Result<void>(const char* call)> before = nullptr;
  bool borrowed = false;  ///< whether the device behaves like one that an engine provides
};

/// Makes a device. New memory contains byte patterns that no kernel can mistake for valid data.
std::unique_ptr<Device> makeHostDevice(HostDeviceOptions options = {});

}  // namespace sgm::cuda

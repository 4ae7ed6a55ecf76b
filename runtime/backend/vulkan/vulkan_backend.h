#pragma once
// Meshes chunks on a Vulkan device, in batches; the CPU meshes those that the device cannot.

#include <filesystem>
#include <functional>

#include "backend/backend.h"
#include "backend/vulkan/batch_plan.h"
#include "backend/vulkan/device.h"
#include "backend/vulkan/memory.h"

namespace sgm {

struct VulkanBackendOptions {
  /// Opens the device; also called after a loss, where an error means that the CPU does all further work. Called by one
  /// thread at a time.
  std::function<Result<std::unique_ptr<vulkan::Device>>()> open;
  std::filesystem::path pipeline_folder;           ///< folder of the pipeline cache; empty: no file
  std::function<void(const std::string&)> inform;  ///< same as BackendRequest::inform
  std::function<void(const std::string&)> warn;    ///< same as BackendRequest::warn
  vulkan::MemoryOptions memory;
  uint64_t resident_cap = UINT64_MAX;  ///< limit in bytes for meshes that stay in the device's memory
  BatchRoom room;
};

/// Creates a backend that meshes on a Vulkan device. The given CPU backend meshes the chunks for which the device has
/// no memory, and the remaining chunks if the device is lost; its results are the same bytes. Errors: those of
/// options.open, if the device cannot be opened at first.
Result<std::unique_ptr<Backend>> makeVulkanBackend(const VulkanBackendOptions& options, std::unique_ptr<Backend> cpu,
                                                   std::pmr::memory_resource* memory, const Profiler& profiler);

}  // namespace sgm

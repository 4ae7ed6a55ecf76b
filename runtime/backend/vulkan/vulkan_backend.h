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
  /// Opens the device, also after a loss; then an error means that the CPU does all. Called by one thread at a time.
  std::function<Result<std::unique_ptr<vulkan::Device>>()> open;
  std::filesystem::path pipeline_folder;           ///< folder of the pipeline cache; empty: not cached
  std::function<void(const std::string&)> inform;  ///< as BackendRequest::inform
  std::function<void(const std::string&)> warn;    ///< as BackendRequest::warn
  vulkan::MemoryOptions memory;
  uint64_t resident_cap = UINT64_MAX;  ///< limit for meshes that stay in the device's memory, bytes
  BatchRoom room;
};

/// Meshes on the device, and on the given CPU backend if the device has no room or is lost; the stream continues with
/// the same bytes. Errors if the device cannot be opened at first: as options.open.
Result<std::unique_ptr<Backend>> makeVulkanBackend(const VulkanBackendOptions& options, std::unique_ptr<Backend> cpu,
                                                   std::pmr::memory_resource* memory, const Profiler& profiler);

}  // namespace sgm

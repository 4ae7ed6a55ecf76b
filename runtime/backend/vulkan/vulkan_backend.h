#pragma once
// Chunks on a Vulkan device, in batches; the CPU takes what the device cannot.

#include <filesystem>
#include <functional>

#include "backend/backend.h"
#include "backend/vulkan/batch_plan.h"
#include "backend/vulkan/device.h"
#include "backend/vulkan/memory.h"

namespace sgm {

struct VulkanBackendOptions {
  /// Opens the device, anew after a loss; an error then means that the CPU does all. Called by one thread at a time.
  std::function<Result<std::unique_ptr<vulkan::Device>>()> open;
  std::filesystem::path pipeline_folder;           ///< where pipelines are kept from run to run; empty: nowhere
  std::function<void(const std::string&)> inform;  ///< as BackendRequest::inform
  std::function<void(const std::string&)> warn;    ///< as BackendRequest::warn
  vulkan::MemoryOptions memory;
  uint64_t resident_cap = UINT64_MAX;  ///< bytes of the device's memory for meshes that stay, at most
  BatchRoom room;
};

/// Meshes what a device has no room for, or loses, by the CPU backend that it is given; the stream goes on, with the
/// same bytes. Errors, where the device cannot even be opened: as options.open.
Result<std::unique_ptr<Backend>> makeVulkanBackend(const VulkanBackendOptions& options, std::unique_ptr<Backend> cpu,
                                                   std::pmr::memory_resource* memory, const Profiler& profiler);

}  // namespace sgm

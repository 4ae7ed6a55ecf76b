#pragma once
// The driver's compiled shaders, cached in a file between runs.
//
// FOLDER/vulkan-VENDOR-DEVICE-DRIVER-CACHEID.cache, all little-endian: "SGMP", version (4 bytes each), size of the
// driver's data, its XXH64 (8 each), the driver's data. Some drivers crash on foreign data, so a file that is damaged
// or of another device is ignored.

#include <array>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "backend/vulkan/device.h"

namespace sgm::vulkan {

/// The name of a device's file, without the folder.
std::string pipelineCacheName(const DeviceInfo& info);

/// The file's bytes for the driver's data. Throws std::bad_alloc.
std::vector<std::byte> packPipelineCache(std::span<const std::byte> data);

/// The driver's data; nullopt unless the bytes are an undamaged file of this device and driver. Accepts any bytes.
std::optional<std::span<const std::byte>> unpackPipelineCache(const DeviceInfo& info, std::span<const std::byte> file);

/// The device must outlive it. Thread-safe.
class PipelineCache {
 public:
  /// folder: created if missing, when saving; empty: cached only in memory. An unusable file is not an error: see
  /// loaded(). Error: out_of_memory. Throws std::bad_alloc.
  static Result<std::unique_ptr<PipelineCache>> create(Device& device, const std::filesystem::path& folder);
  ~PipelineCache();
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  /// Replaces the whole file; does nothing without a folder, or if the file already has all data. Errors: io,
  /// out_of_memory.
  /// Errors: io, out_of_memory.
  Result<void> save();

  bool loaded() const { return loaded_; }  ///< started with an earlier run's data
  VkPipelineCache handle() const { return cache_; }

 private:
  explicit PipelineCache(Device& device) : device_(device) {}

  Device& device_;
  std::filesystem::path file_;  // empty: no file
  VkPipelineCache cache_ = VK_NULL_HANDLE;
  bool loaded_ = false;
  std::mutex saving_;
  uint64_t saved_ = 0;  // checksum of the driver's data in the file
};

}  // namespace sgm::vulkan

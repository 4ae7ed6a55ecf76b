#pragma once
// The driver's compiled shaders, stored in a file from one run to the next.
//
// Layout of the file FOLDER/vulkan-VENDOR-DEVICE-DRIVER-CACHEID.cache, all little-endian: "SGMP", version (4 bytes
// each); size of the driver's data, XXH64 of the data (8 bytes each); the driver's data. Some drivers crash on data of
// other devices, so a file that is damaged or belongs to another device is ignored.

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

/// Returns the name of a device's file, without the folder.
std::string pipelineCacheName(const DeviceInfo& info);

/// Returns the bytes of a file with the driver's data. Throws std::bad_alloc.
std::vector<std::byte> packPipelineCache(std::span<const std::byte> data);

/// Returns the driver's data in a file; nullopt unless the bytes are an undamaged file of this device and driver.
/// Accepts any bytes.
std::optional<std::span<const std::byte>> unpackPipelineCache(const DeviceInfo& info, std::span<const std::byte> file);

/// The cache of one device. The device must outlive it. Thread-safe.
class PipelineCache {
 public:
  /// folder: created by save() if it is missing; empty: the cache is only in memory. An unusable file is not an error:
  /// see loaded(). Error: out_of_memory. Throws std::bad_alloc.
  static Result<std::unique_ptr<PipelineCache>> create(Device& device, const std::filesystem::path& folder);
  ~PipelineCache();
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  /// Replaces the whole file; does nothing without a folder, or if the file already contains all data. Errors: io,
  /// out_of_memory.
  Result<void> save();

  bool loaded() const { return loaded_; }  ///< true if the cache started with the data of an earlier run
  VkPipelineCache handle() const { return cache_; }

 private:
  explicit PipelineCache(Device& device) : device_(device) {}

  Device& device_;
  std::filesystem::path file_;  // path of the cache file; empty: no file
  VkPipelineCache cache_ = VK_NULL_HANDLE;
  bool loaded_ = false;
  std::mutex saving_;
  uint64_t saved_ = 0;  // checksum of the driver's data in the file
};

}  // namespace sgm::vulkan

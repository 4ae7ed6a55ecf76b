#pragma once
// What the driver made of the shaders, kept in a file between runs.
//
// FOLDER/vulkan-VENDOR-DEVICE-DRIVER-CACHEID.cache, all little-endian: "SGMP", version (4 bytes each), size of the
// driver's data, its XXH64 (8 each), the driver's data. Drivers are known to crash on data that is not theirs, so a
// file that is damaged or another device's is as good as none.

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

/// The file's bytes around the driver's data. Throws std::bad_alloc.
std::vector<std::byte> packPipelineCache(std::span<const std::byte> data);

/// The driver's data; none unless the bytes are those of an undamaged file of this device and driver. For any bytes.
std::optional<std::span<const std::byte>> unpackPipelineCache(const DeviceInfo& info, std::span<const std::byte> file);

/// Outlived by its device. Any thread may use it.
class PipelineCache {
 public:
  /// folder: made where it is missing, when saving; empty: the cache lasts as long as the object. A file that cannot be
  /// used is no error: see loaded(). Error: out_of_memory. Throws std::bad_alloc.
  static Result<std::unique_ptr<PipelineCache>> create(Device& device, const std::filesystem::path& folder);
  ~PipelineCache();
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  /// Replaces the file as a whole; does nothing where there is no folder, or nothing that the file did not hold.
  /// Errors: io, out_of_memory.
  Result<void> save();

  bool loaded() const { return loaded_; }  ///< begun with what an earlier run saved
  VkPipelineCache handle() const { return cache_; }

 private:
  explicit PipelineCache(Device& device) : device_(device) {}

  Device& device_;
  std::filesystem::path file_;  // empty: none
  VkPipelineCache cache_ = VK_NULL_HANDLE;
  bool loaded_ = false;
  std::mutex saving_;
  uint64_t saved_ = 0;  // checksum of the driver's data in the file
};

}  // namespace sgm::vulkan

#include "backend/vulkan/pipeline_cache.h"

#include <bit>
#include <cstring>

#include "base/checksum.h"
#include "base/file_reader.h"
#include "base/file_writer.h"
#include "base/plain_text.h"

namespace sgm::vulkan {
namespace {

static_assert(std::endian::native == std::endian::little, "files have the byte order of memory");

struct FileHeader {
  std::array<char, 4> magic{'S', 'G', 'M', 'P'};
  uint32_t version = 1;
  uint64_t bytes = 0, hash = 0;
  friend bool operator==(const FileHeader&, const FileHeader&) = default;
};
static_assert(sizeof(FileHeader) == 24);

// largest size of a cache file that is read, in bytes; this library's shaders take some 100 KB
constexpr uint64_t kLargestFile = uint64_t{256} << 20;

FileHeader headerFor(std::span<const std::byte> data) {
  FileHeader header;
  header.bytes = data.size();
  header.hash = checksum(data);
  return header;
}

}  // namespace

std::string pipelineCacheName(const DeviceInfo& info) {
  std::string name = "vulkan-";
  for (const uint32_t number : {info.vendor, info.device, info.driver_version}) name += hexText(number, 8) + "-";
  for (const uint8_t byte : info.cache_id) name += hexText(byte, 2);
  return name + ".cache";
}

std::vector<std::byte> packPipelineCache(std::span<const std::byte> data) {
  const FileHeader header = headerFor(data);
  std::vector<std::byte> file(sizeof header + data.size());
  std::memcpy(file.data(), &header, sizeof header);
  if (!data.empty()) std::memcpy(file.data() + sizeof header, data.data(), data.size());
  return file;
}

std::optional<std::span<const std::byte>> unpackPipelineCache(const DeviceInfo& info, std::span<const std::byte> file) {
  FileHeader header;
  VkPipelineCacheHeaderVersionOne driver;
  if (file.size() < sizeof header + sizeof driver) return std::nullopt;
  std::memcpy(&header, file.data(), sizeof header);
  const std::span data = file.subspan(sizeof header);
  if (header != headerFor(data)) return std::nullopt;
  std::memcpy(&driver, data.data(), sizeof driver);
  if (driver.headerSize < sizeof driver || driver.headerVersion != VK_PIPELINE_CACHE_HEADER_VERSION_ONE ||
      driver.vendorID != info.vendor || driver.deviceID != info.device ||
      std::memcmp(driver.pipelineCacheUUID, info.cache_id.data(), VK_UUID_SIZE) != 0) {
    return std::nullopt;
  }
  return data;
}

Result<std::unique_ptr<PipelineCache>> PipelineCache::create(Device& device, const std::filesystem::path& folder) {
  std::unique_ptr<PipelineCache> cache(new PipelineCache(device));
  // If the file is missing or cannot be read, the cache starts empty.
  Result<std::string> file = std::string();
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  if (!folder.empty()) {
    cache->file_ = folder / pipelineCacheName(device.info());
    file = readFile(cache->file_, kLargestFile);
    const auto data = file ? unpackPipelineCache(device.info(), std::as_bytes(std::span(*file))) : std::nullopt;
    if (data) {
      info.initialDataSize = data->size();
      info.pInitialData = data->data();
      cache->loaded_ = true;
      cache->saved_ = checksum(*data);
    }
  }
  const VkResult result = device.calls().vkCreatePipelineCache(device.handle(), &info, nullptr, &cache->cache_);
  if (result != VK_SUCCESS) return errorOf(result, "creating a pipeline cache");
  return cache;
}

PipelineCache::~PipelineCache() { device_.calls().vkDestroyPipelineCache(device_.handle(), cache_, nullptr); }

Result<void> PipelineCache::save() {
  if (file_.empty()) return {};
  const std::scoped_lock lock(saving_);
  const DeviceTable& calls = device_.calls();
  std::vector<std::byte> data;
  // The first call asks for the size of the cache's data, the second one for the data. Both are repeated if another
  // thread has added to the cache in between.
  VkResult result = VK_INCOMPLETE;
  while (result == VK_INCOMPLETE) {
    size_t bytes = 0;
    result = calls.vkGetPipelineCacheData(device_.handle(), cache_, &bytes, nullptr);
    if (result != VK_SUCCESS) break;
    data.resize(bytes);
    result = calls.vkGetPipelineCacheData(device_.handle(), cache_, &bytes, data.data());
    data.resize(bytes);
  }
  if (result != VK_SUCCESS) return errorOf(result, "saving the pipeline cache");
  const uint64_t hash = checksum(data);
  if (hash == saved_) return {};
  std::error_code error;
  std::filesystem::create_directories(file_.parent_path(), error);
  if (error) {
    return Error{Code::io, "cannot make the folder " + file_.parent_path().string() + ": " + systemMessage(error)};
  }
  auto writer = FileWriter::create(file_);
  if (!writer) return writer.error();
  const std::vector<std::byte> packed = packPipelineCache(data);
  writer->write(packed.data(), packed.size());
  if (auto committed = writer->commit(); !committed) return committed.error();
  saved_ = hash;
  return {};
}

}  // namespace sgm::vulkan

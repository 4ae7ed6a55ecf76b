#include "backend/vulkan/pipeline_cache.h"

#include <fstream>
#include <random>

#include "support.h"
#include "temporary_folder.h"

using namespace sgm;
using namespace sgm::vulkan;
namespace fs = std::filesystem;

namespace {

std::vector<std::byte> readAll(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

void writeAll(const fs::path& path, std::span<const std::byte> bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// The cache data that a driver would write: a header, and some more bytes.
std::vector<std::byte> driverData(const DeviceInfo& info) {
  VkPipelineCacheHeaderVersionOne header{};
  header.headerSize = sizeof header;
  header.headerVersion = VK_PIPELINE_CACHE_HEADER_VERSION_ONE;
  header.vendorID = info.vendor;
  header.deviceID = info.device;
  std::copy(info.cache_id.begin(), info.cache_id.end(), header.pipelineCacheUUID);
  std::vector<std::byte> data(sizeof header + 100, std::byte{42});
  std::memcpy(data.data(), &header, sizeof header);
  return data;
}

DeviceInfo someDevice() {
  DeviceInfo info;
  info.vendor = 0x10DE;
  info.device = 7;
  info.driver_version = 3;
  for (size_t i = 0; i < info.cache_id.size(); ++i) info.cache_id[i] = static_cast<uint8_t>(17 * i);
  return info;
}

}  // namespace

TEST_CASE("a pipeline cache's file is taken whole, undamaged and of this device, or not at all", "[vulkan]") {
  const DeviceInfo info = someDevice();
  const std::vector<std::byte> data = driverData(info), file = packPipelineCache(data);
  const auto taken = unpackPipelineCache(info, file);
  REQUIRE(taken);
  CHECK(std::equal(taken->begin(), taken->end(), data.begin(), data.end()));
  for (size_t bytes = 0; bytes < file.size(); ++bytes) {
    CHECK(!unpackPipelineCache(info, std::span(file).first(bytes)));
  }
  for (size_t i = 0; i < file.size(); ++i) {
    std::vector<std::byte> damaged = file;
    damaged[i] ^= std::byte{16};
    CHECK(!unpackPipelineCache(info, damaged));
  }
  std::vector<std::byte> longer = file;
  longer.push_back(std::byte{});
  CHECK(!unpackPipelineCache(info, longer));
  for (int what = 0; what < 3; ++what) {
    DeviceInfo other = info;
    if (what == 0) ++other.vendor;
    if (what == 1) ++other.device;
    if (what == 2) ++other.cache_id[15];
    CHECK(!unpackPipelineCache(other, file));
    CHECK(pipelineCacheName(other) != pipelineCacheName(info));
  }
  DeviceInfo updated = info;
  ++updated.driver_version;
  CHECK(pipelineCacheName(updated) != pipelineCacheName(info));
  CHECK(pipelineCacheName(info) == "vulkan-000010de-00000007-00000003-00112233445566778899aabbccddeeff.cache");
}

TEST_CASE("a pipeline cache lasts from run to run, and mends what is damaged", "[vulkan]") {
  TestDevice device;
  if (!device) return;
  const TemporaryFolder folder;
  const fs::path deeper = folder.path / "a" / "b", file = deeper / pipelineCacheName(device.device->info());
  const std::vector<int32_t> numbers{1};
  const auto run = [&] {
    const bool loaded = (*PipelineCache::create(*device, deeper))->loaded();
    CHECK(throughAllLayers(*device, numbers, deeper));
    return loaded;
  };
  CHECK(!run());
  REQUIRE(fs::exists(file));
  const std::vector<std::byte> saved = readAll(file);
  CHECK(unpackPipelineCache(device.device->info(), saved));
  // If the file already has all pipelines, it is not written again.
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(file, long_ago);
  CHECK(run());
  CHECK(fs::last_write_time(file) == long_ago);
  std::vector<std::byte> damaged = saved;
  damaged.back() ^= std::byte{1};
  writeAll(file, damaged);
  CHECK(!run());
  CHECK(run());
  writeAll(file, packPipelineCache(driverData(someDevice())));  // the file of this device has data of another device
  CHECK(!run());
  writeAll(file, {});
  CHECK(!run());
  fs::remove(file);
  fs::create_directory(file);
  CHECK(!(*PipelineCache::create(*device, deeper))->loaded());
  fs::remove(file);
  CHECK(!run());
  CHECK(run());
  CHECK(std::distance(fs::directory_iterator(deeper), {}) == 1);
}

TEST_CASE("a pipeline cache that cannot be saved says so", "[vulkan]") {
  TestDevice device;
  if (!device) return;
  const TemporaryFolder folder;
  writeAll(folder.path / "file", {});
  const auto cache = PipelineCache::create(*device, folder.path / "file" / "folder");
  REQUIRE(cache);
  const uint32_t constants[] = {0, 1};
  REQUIRE(Pipeline::create(*device, affineShader(constants), cache->get()));
  const auto saved = (*cache)->save();
  REQUIRE(!saved);
  CHECK(saved.error().code == Code::io);
}

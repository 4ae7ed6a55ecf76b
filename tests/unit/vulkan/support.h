#pragma once
// A device to test on, a shader to run on it, and calls that fail when told.

#include <dlfcn.h>
#include <link.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "backend/vulkan/commands.h"
#include "catch.h"
#include "rounds.h"
#include "spirv/affine_comp.h"

namespace sgm::vulkan {

inline OwnDevice watched(std::shared_ptr<MessageLog> log = std::make_shared<MessageLog>()) {
  OwnDevice options;
  options.software = true;
  options.validation = Validation::synchronization;
  options.log = std::move(log);
  return options;
}

/// Keeps every library that is loaded now in memory to the end: drivers and layers leave allocations behind when they
/// are unloaded, which a leak checker could not tell from ours.
inline void keepLibraries() {
  dl_iterate_phdr(
      [](dl_phdr_info* info, size_t, void*) {
        if (info->dlpi_name && *info->dlpi_name) dlopen(info->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
        return 0;
      },
      nullptr);
}

/// false, after saying so, where this machine has no usable Vulkan device; an error where the tests must not be
/// skipped.
inline bool haveDevice() {
  static const std::string missing = [] {
    if (const auto device = Device::open(watched())) keepLibraries();
    const auto devices = listDevices();
    if (!devices) return devices.error().message;
    std::string lacks = "no usable Vulkan device here";
    for (const DeviceInfo& info : *devices) {
      const std::string lack = lackOf(info);
      if (lack.empty()) return lack;
      lacks += "; " + lack;
    }
    return lacks;
  }();
  if (missing.empty()) return true;
  INFO(missing);
  REQUIRE(std::getenv("SGM_REQUIRE_VULKAN") == nullptr);
  std::fprintf(stderr, "SKIPPED: %s\n", missing.c_str());
  return false;
}

/// A device that the validation layer watches, which has to be silent until the end.
struct TestDevice {
  std::shared_ptr<MessageLog> log = std::make_shared<MessageLog>();
  std::unique_ptr<Device> device;

  TestDevice() {
    if (!haveDevice()) return;
    auto opened = Device::open(watched(log));
    INFO((opened ? std::string() : opened.error().message));
    REQUIRE(opened);
    device = std::move(*opened);
  }
  ~TestDevice() {
    device.reset();
    CHECK(log->texts() == std::vector<std::string>());
  }
  explicit operator bool() const { return device != nullptr; }
  Device& operator*() const { return *device; }
};

inline PipelineDesc affineShader(std::span<const uint32_t> constants) {
  PipelineDesc desc;
  desc.name = "affine";
  desc.spirv = spirv::kAffineComp;
  desc.buffers = 2;
  desc.push_bytes = sizeof(int32_t);
  desc.constants = constants;
  return desc;
}

template <class T>
std::span<const std::byte> bytesOf(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

inline std::vector<int32_t> numbersOf(const Buffer& buffer) {
  std::vector<int32_t> numbers(buffer.size() / sizeof(int32_t));
  std::memcpy(numbers.data(), buffer.data(), numbers.size() * sizeof(int32_t));
  return numbers;
}

inline void write(const Buffer& buffer, std::span<const int32_t> numbers) {
  std::memcpy(buffer.data(), numbers.data(), numbers.size_bytes());
}

/// All layers once: numbers go up, through a shader twice (the second time by counts that a shader has written) and
/// come back as 3 * (3 * x + 5) + 5.
Result<std::vector<int32_t>> throughAllLayers(Device& device, std::span<const int32_t> numbers,
                                              const std::filesystem::path& cache_folder);

}  // namespace sgm::vulkan

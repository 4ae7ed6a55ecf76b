#pragma once
// Support for tests with Vulkan: a device, a shader that runs on it, and Vulkan calls that can be made to fail.

#include <array>
#include <cstring>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "backend/vulkan/commands.h"
#include "catch.h"
#include "have_device.h"
#include "rounds.h"
#include "spirv/affine_comp.h"

namespace sgm::vulkan {

/// A device with the validation layer, which must report nothing until the device's end.
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

/// Uses all layers of the Vulkan code once: uploads numbers, runs a shader over them twice (the second time with a
/// dispatch size that a shader has written), and downloads 3 * (3 * x + 5) + 5.
Result<std::vector<int32_t>> throughAllLayers(Device& device, std::span<const int32_t> numbers,
                                              const std::filesystem::path& cache_folder);

}  // namespace sgm::vulkan

#pragma once
// Checks whether this machine has a Vulkan device for the tests.

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "backend/vulkan/device.h"
#include "catch.h"
#include "keep_libraries.h"

namespace sgm::vulkan {

inline OwnDevice watched(std::shared_ptr<MessageLog> log = std::make_shared<MessageLog>()) {
  OwnDevice options;
  options.software = true;
  options.validation = Validation::synchronization;
  options.log = std::move(log);
  return options;
}

/// Returns false, after printing the reason, if this machine has no usable Vulkan device; fails if the tests must not
/// be skipped.
inline bool haveDevice() {
  static const std::string missing = [] {
    if (const auto device = Device::open(watched())) keepLibraries();
    const auto devices = listDevices();
    if (!devices) return devices.error().message;
    std::string lacks = "there is no usable Vulkan device";
    for (const DeviceInfo& info : *devices) {
      const std::string lack = unsupportedReason(info);
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

}  // namespace sgm::vulkan

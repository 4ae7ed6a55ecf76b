#pragma once
// Whether this machine has a device to test on.

#include <dlfcn.h>
#include <link.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "backend/vulkan/device.h"
#include "catch.h"

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

}  // namespace sgm::vulkan

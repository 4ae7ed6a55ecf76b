// Tests which devices are rejected, and the reasons: mostly with simulated properties of devices.

#include "backend/vulkan/devices.h"

#include <functional>

#include "support.h"

using namespace sgm;
using namespace sgm::vulkan;

namespace {

DeviceInfo goodDevice() {
  DeviceInfo info;
  info.name = "Vendor GPU 9000";
  info.type = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
  info.api_version = VK_API_VERSION_1_2;
  info.computes = true;
  info.max_storage_range = uint64_t{128} << 20;
  info.max_shared_bytes = 32768;
  info.max_invocations = 256;
  info.max_push_bytes = 128;
  info.max_storage_buffers = 8;
  info.timeline_semaphores = true;
  info.subgroups_compute = true;
  info.subgroup_operations = VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_VOTE_BIT |
                             VK_SUBGROUP_FEATURE_BALLOT_BIT | VK_SUBGROUP_FEATURE_ARITHMETIC_BIT |
                             VK_SUBGROUP_FEATURE_SHUFFLE_BIT;
  info.subgroup_size = 8;
  return info;
}

}  // namespace

TEST_CASE("a device that has just enough can be used, of any vendor and kind", "[vulkan]") {
  DeviceInfo info = goodDevice();
  CHECK(unsupportedReason(info).empty());
  info.subgroup_size = 64;
  info.exact = false;
  for (const uint32_t vendor : {0x1002u, 0x10DEu, 0x8086u, 0x13B5u, 0x10005u}) {
    info.vendor = vendor;
    for (const auto type : {VK_PHYSICAL_DEVICE_TYPE_OTHER, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
                            VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_CPU}) {
      info.type = type;
      CHECK(unsupportedReason(info).empty());
      CHECK(info.software() == (type == VK_PHYSICAL_DEVICE_TYPE_CPU));
    }
  }
}

TEST_CASE("a device that lacks one thing is refused by its name", "[vulkan]") {
  const struct {
    const char* named;
    std::function<void(DeviceInfo&)> spoil;
  } lacks[] = {
      {"Vulkan 1.1.200", [](DeviceInfo& info) { info.api_version = VK_MAKE_API_VERSION(0, 1, 1, 200); }},
      {"a compute queue", [](DeviceInfo& info) { info.computes = false; }},
      {"timelineSemaphore", [](DeviceInfo& info) { info.timeline_semaphores = false; }},
      {"subgroup operations in compute", [](DeviceInfo& info) { info.subgroups_compute = false; }},
      {"basic", [](DeviceInfo& info) { info.subgroup_operations ^= VK_SUBGROUP_FEATURE_BASIC_BIT; }},
      {"vote", [](DeviceInfo& info) { info.subgroup_operations ^= VK_SUBGROUP_FEATURE_VOTE_BIT; }},
      {"ballot", [](DeviceInfo& info) { info.subgroup_operations ^= VK_SUBGROUP_FEATURE_BALLOT_BIT; }},
      {"arithmetic", [](DeviceInfo& info) { info.subgroup_operations ^= VK_SUBGROUP_FEATURE_ARITHMETIC_BIT; }},
      {"shuffle", [](DeviceInfo& info) { info.subgroup_operations ^= VK_SUBGROUP_FEATURE_SHUFFLE_BIT; }},
      {"subgroupSize of 4", [](DeviceInfo& info) { info.subgroup_size = 4; }},
      {"subgroupSize of 128", [](DeviceInfo& info) { info.subgroup_size = 128; }},
      {"maxStorageBufferRange of 134217727", [](DeviceInfo& info) { --info.max_storage_range; }},
      {"maxComputeSharedMemorySize of 16384", [](DeviceInfo& info) { info.max_shared_bytes = 16384; }},
      {"maxComputeWorkGroupInvocations of 128", [](DeviceInfo& info) { info.max_invocations = 128; }},
      {"maxPushConstantsSize of 64", [](DeviceInfo& info) { info.max_push_bytes = 64; }},
      {"maxPerStageDescriptorStorageBuffers of 4", [](DeviceInfo& info) { info.max_storage_buffers = 4; }},
  };
  for (const auto& lack : lacks) {
    DeviceInfo info = goodDevice();
    lack.spoil(info);
    const std::string reason = unsupportedReason(info);
    INFO(reason);
    CHECK(reason.find(info.name) == 0);
    CHECK(reason.find(lack.named) != std::string::npos);
  }
}

TEST_CASE("the devices of this machine say who they are", "[vulkan]") {
  if (!haveDevice()) return;
  const auto devices = listDevices();
  REQUIRE(devices);
  for (const DeviceInfo& info : *devices) {
    CHECK(!info.name.empty());
    CHECK(info.api_version >= VK_API_VERSION_1_0);
    if (unsupportedReason(info).empty()) {
      CHECK(!info.driver.empty());
      CHECK(info.max_allocation >= uint64_t{1} << 30);
    }
  }
}

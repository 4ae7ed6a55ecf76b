// sgm backends: what can compute here, and what can draw.

#include <fmt/core.h>

#include "backend/vulkan/devices.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "sgm/sgm.h"

namespace sgm::cli {
namespace {

const char* typeName(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "software";
    default:
      return "other";
  }
}

Json deviceJson(const vulkan::DeviceInfo& device) {
  const std::string lack = vulkan::lackOf(device);
  Json one{{"name", device.name},
           {"type", typeName(device.type)},
           {"driver", device.driver},
           {"software", device.software()},
           {"usable", lack.empty()}};
  if (lack.empty()) {
    one.update({{"exact", device.exact}, {"preserves_denormals", device.preserves_denormals}});
  } else {
    one["reason"] = lack;
  }
  return one;
}

void printDevice(const vulkan::DeviceInfo& device) {
  const std::string lack = vulkan::lackOf(device);
  fmt::print("  {} ({}{}{}): ", device.name, typeName(device.type), device.driver.empty() ? "" : ", ", device.driver);
  if (lack.empty()) {
    fmt::print("usable, {}\n", device.exact ? "exact" : "not exact");
  } else {
    fmt::print("not usable: {}\n", lack);
  }
}

}  // namespace

Exit listBackends(bool json) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_runtime* runtime = nullptr;
  if (sgm_runtime_create(nullptr, &runtime, &error) != SGM_OK) return complain(Exit::backend, error.message);
  std::vector<sgm_backend_info> infos;
  sgm_result result = SGM_OK;
  for (const sgm_backend backend : {SGM_BACKEND_AUTO, SGM_BACKEND_CPU, SGM_BACKEND_VULKAN, SGM_BACKEND_CUDA}) {
    sgm_backend_info& info = infos.emplace_back(sgm_backend_info SGM_BACKEND_INFO_INIT);
    result = sgm_backend_query(runtime, backend, &info, &error);
    if (result != SGM_OK) break;
  }
  sgm_runtime_destroy(runtime);
  if (result != SGM_OK) return complain(Exit::backend, error.message);

  const Result<std::vector<vulkan::DeviceInfo>> gpus = vulkan::listDevices();
  if (json) {
    Json list = Json::array();
    for (size_t i = 1; i < infos.size(); ++i) {
      const sgm_backend_info& info = infos[i];
      Json one{{"name", info.name}, {"usable", info.usable != 0}};
      if (info.usable != 0) {
        one.update({{"device", info.device}, {"exact", info.exact != 0}, {"concurrency", info.concurrency}});
      } else {
        one["reason"] = info.reason;
      }
      list.push_back(std::move(one));
    }
    Json devices = Json::array();
    if (gpus) {
      for (const vulkan::DeviceInfo& gpu : *gpus) devices.push_back(deviceJson(gpu));
    }
    Json out{{"version", sgm_version_string()},
             {"build", sgm_build_info()},
             {"auto", infos[0].name},
             {"backends", std::move(list)},
             {"vulkan_devices", std::move(devices)}};
    if (!gpus) out["vulkan_error"] = gpus.error().message;
    fmt::print("{}\n", out.text());
    return Exit::done;
  }
  fmt::print("{}\nauto chooses {}\n\n", sgm_build_info(), infos[0].name);
  for (size_t i = 1; i < infos.size(); ++i) {
    const sgm_backend_info& info = infos[i];
    if (info.usable != 0) {
      fmt::print("{:<8}usable: {}, {} at a time{}\n", info.name, info.device, info.concurrency,
                 info.exact != 0 ? ", exact" : ", not exact");
    } else {
      fmt::print("{:<8}not usable: {}\n", info.name, info.reason);
    }
  }
  fmt::print("\nVulkan devices:\n");
  if (!gpus) {
    fmt::print("  none: {}\n", gpus.error().message);
    return Exit::done;
  }
  if (gpus->empty()) fmt::print("  none\n");
  for (const vulkan::DeviceInfo& gpu : *gpus) printDevice(gpu);
  return Exit::done;
}

}  // namespace sgm::cli

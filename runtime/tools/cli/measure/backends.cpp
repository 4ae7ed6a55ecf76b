// `sgm backends`: lists devices for computing and for drawing.

#include <fmt/core.h>

#include "backend/vulkan/devices.h"
#include "base/json.h"
#include "cuda/driver_device.h"
#include "sgm/sgm.h"
#include "tools/cli/measure/commands.h"
#include "tools/support/console.h"

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
  const std::string lack = vulkan::unsupportedReason(device);
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
  const std::string lack = vulkan::unsupportedReason(device);
  fmt::print("  {} ({}{}{}): ", device.name, typeName(device.type), device.driver.empty() ? "" : ", ", device.driver);
  if (lack.empty()) {
    fmt::print("usable, {}\n", device.exact ? "exact" : "not exact");
  } else {
    fmt::print("not usable: {}\n", lack);
  }
}

Json deviceJson(const cuda::DeviceInfo& device) {
  const std::string lack = cuda::unsupportedReason(device);
  Json one{{"name", device.name},
           {"compute_capability", fmt::format("{}.{}", device.capability_major, device.capability_minor)},
           {"driver", fmt::format("{}.{}", device.driver / 1000, device.driver % 1000 / 10)},
           {"memory_bytes", device.memory},
           {"multiprocessors", device.processors},
           {"usable", lack.empty()}};
  if (!lack.empty()) one["reason"] = lack;
  return one;
}

void printDevice(const cuda::DeviceInfo& device) {
  const std::string lack = cuda::unsupportedReason(device);
  fmt::print("  {} (compute capability {}.{}, {} multiprocessors, {:.1f} GB, CUDA {}.{}): {}\n", device.name,
             device.capability_major, device.capability_minor, device.processors,
             static_cast<double>(device.memory) * 1e-9, device.driver / 1000, device.driver % 1000 / 10,
             lack.empty() ? "usable, exact" : "not usable: " + lack);
}

/// Prints the devices of one kind, or the error that prevented listing them.
template <class Device>
void printDevices(const char* kind, const Result<std::vector<Device>>& devices) {
  fmt::print("\n{} devices:\n", kind);
  if (!devices) fmt::print("  none: {}\n", devices.error().message);
  if (devices && devices->empty()) fmt::print("  none\n");
  for (size_t i = 0; devices && i < devices->size(); ++i) printDevice((*devices)[i]);
}

template <class Device>
void addDevices(const char* kind, const Result<std::vector<Device>>& devices, Json& out) {
  Json list = Json::array();
  for (size_t i = 0; devices && i < devices->size(); ++i) list.push_back(deviceJson((*devices)[i]));
  out[std::string(kind) + "_devices"] = std::move(list);
  if (!devices) out[std::string(kind) + "_error"] = devices.error().message;
}

}  // namespace

Exit listBackends(bool json) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_runtime* runtime = nullptr;
  if (sgm_runtime_create(nullptr, &runtime, &error) != SGM_OK) return reportError(Exit::backend, error.message);
  std::vector<sgm_backend_info> infos;
  sgm_result result = SGM_OK;
  for (const sgm_backend backend : {SGM_BACKEND_AUTO, SGM_BACKEND_CPU, SGM_BACKEND_VULKAN, SGM_BACKEND_CUDA}) {
    sgm_backend_info& info = infos.emplace_back(sgm_backend_info SGM_BACKEND_INFO_INIT);
    result = sgm_backend_query(runtime, backend, &info, &error);
    if (result != SGM_OK) break;
  }
  sgm_runtime_destroy(runtime);
  if (result != SGM_OK) return reportError(Exit::backend, error.message);

  const Result<std::vector<vulkan::DeviceInfo>> by_vulkan = vulkan::listDevices();
  const Result<std::vector<cuda::DeviceInfo>> by_cuda = cuda::listDevices();
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
    Json out{{"version", sgm_version_string()},
             {"build", sgm_build_info()},
             {"auto", infos[0].name},
             {"backends", std::move(list)}};
    addDevices("vulkan", by_vulkan, out);
    addDevices("cuda", by_cuda, out);
    fmt::print("{}\n", out.text());
    return Exit::done;
  }
  fmt::print("{}\nauto chooses {}\n\n", sgm_build_info(), infos[0].name);
  for (size_t i = 1; i < infos.size(); ++i) {
    const sgm_backend_info& info = infos[i];
    if (info.usable != 0) {
      fmt::print("{:<8}usable: {}, {} chunks concurrently{}\n", info.name, info.device, info.concurrency,
                 info.exact != 0 ? ", exact" : ", not exact");
    } else {
      fmt::print("{:<8}not usable: {}\n", info.name, info.reason);
    }
  }
  printDevices("Vulkan", by_vulkan);
  printDevices("CUDA", by_cuda);
  return Exit::done;
}

}  // namespace sgm::cli

#pragma once
// A Vulkan backend whose device the validation layer checks, and the CPU backend with which it is compared.

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "backend/backend.h"
#include "backend/cpu/cpu_backend.h"
#include "backend/vulkan/vulkan_backend.h"
#include "catch.h"
#include "mesh_jobs.h"

namespace sgm {

/// Makes both backends; the Vulkan device may be a software device. Every test that uses it ends with
/// CHECK(machine.silent()).
struct VulkanMachine {
  std::shared_ptr<vulkan::MessageLog> log = std::make_shared<vulkan::MessageLog>();
  std::unique_ptr<JobSystem> jobs = *makeThreadPool(2);
  std::unique_ptr<Backend> scalar = *makeCpuBackend("scalar", *jobs, std::pmr::get_default_resource(), {});
  std::unique_ptr<Backend> vulkan;  ///< null if this machine has no usable device; the reason has then been printed

  std::vector<std::string> warnings;  ///< warnings that the Vulkan backend has given

  /// False: prisms with many corners exceed a shader's limit, so the CPU meshes them.
  static constexpr bool kAnyPrism = false;
  Backend& device() const { return *vulkan; }

  using Open = std::function<Result<std::unique_ptr<vulkan::Device>>()>;

  /// open: opens the device to use; null: opens a new device, whose calls the validation layer checks.
  explicit VulkanMachine(const BatchRoom& room = {}, const Open& open = nullptr)
      : VulkanMachine(optionsOf(room, open)) {}
  /// If options.open is null, opens a new device, whose calls the validation layer checks.
  explicit VulkanMachine(VulkanBackendOptions options) {
    options.warn = [this](const std::string& text) { warnings.push_back(text); };
    if (!options.open) options.open = [log_of_all = log] { return vulkan::Device::open(watched(log_of_all)); };
    Result<std::unique_ptr<Backend>> cpu = makeCpuBackend("", *jobs, std::pmr::get_default_resource(), {});
    REQUIRE(cpu);
    Result<std::unique_ptr<Backend>> made =
        makeVulkanBackend(options, std::move(*cpu), std::pmr::get_default_resource(), {});
    if (made) {
      vulkan = std::move(*made);
      return;
    }
    INFO(made.error().message);
    REQUIRE(std::getenv("SGM_REQUIRE_VULKAN") == nullptr);
    std::fprintf(stderr, "SKIPPED: %s\n", made.error().message.c_str());
  }
  VulkanMachine(const VulkanMachine&) = delete;
  VulkanMachine& operator=(const VulkanMachine&) = delete;
  explicit operator bool() const { return vulkan != nullptr; }

  static VulkanBackendOptions optionsOf(const BatchRoom& room, const Open& open) {
    VulkanBackendOptions options;
    options.room = room;
    options.open = open;
    return options;
  }

  static vulkan::OwnDevice watched(std::shared_ptr<vulkan::MessageLog> log,
                                   vulkan::Validation validation = vulkan::Validation::synchronization) {
    vulkan::OwnDevice device;
    device.software = true;
    device.validation = validation;
    device.log = std::move(log);
    return device;
  }

  /// True if the validation layer has reported nothing.
  bool silent() const { return silent(log->texts()); }
  static bool silent(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) UNSCOPED_INFO(text);
    return texts.empty();
  }
};

using TestedMachine = VulkanMachine;

}  // namespace sgm

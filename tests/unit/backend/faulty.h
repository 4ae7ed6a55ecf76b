#pragma once
// A Vulkan backend on an engine's device whose calls fail on request, and checks of what it leaves there.

#include <filesystem>
#include <memory>

#include "kept_pipelines.h"
#include "unit/vulkan/faults.h"
#include "vulkan_machine.h"

namespace sgm {

/// Opening the device again after a failure takes no time, because the engine's device stays open.
struct Faulty : vulkan::KeptEngine {
  vulkan::Faults faults;

  Faulty() : KeptEngine(vulkan::Validation::core) {}  // synchronization errors: see VulkanMachine::silent

  vulkan::BorrowedDevice lend() {
    vulkan::BorrowedDevice external = engine.lend();
    external.replace_calls = [](vulkan::DeviceTable& table) {
      vulkan::KeptPipelines::wrap(table);
      vulkan::Faults::wrap(table);
    };
    return external;
  }
  VulkanMachine machine(VulkanBackendOptions options) {
    options.open = [this] { return vulkan::Device::borrow(lend()); };
    return VulkanMachine(options);
  }
  VulkanMachine machine(const BatchRoom& room = {}, const std::filesystem::path& pipeline_folder = {}) {
    VulkanBackendOptions options;
    options.room = room;
    options.pipeline_folder = pipeline_folder;
    return machine(options);
  }
};

// Tests in files of their own that use the same device, so that its pipelines are made only once.
void checkFarDevice(Faulty& faulty);       ///< vulkan_far_test.cpp
void checkMeshesThatStay(Faulty& faulty);  ///< vulkan_resident_faults_test.cpp

}  // namespace sgm

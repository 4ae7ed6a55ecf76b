#pragma once
// A Vulkan backend that borrows an engine's device, with Vulkan calls that fail on request.

#include <filesystem>
#include <memory>

#include "kept_pipelines.h"
#include "unit/vulkan/faults.h"
#include "vulkan_machine.h"

namespace sgm {

/// A backend whose Vulkan calls can be made to fail. The engine keeps its device open, so the backend can open the
/// device again without delay after a failure.
struct Faulty : vulkan::KeptEngine {
  vulkan::Faults faults;

  Faulty() : KeptEngine(vulkan::Validation::core) {}  // checks no synchronization: see VulkanMachine::silent

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

// Tests that vulkan_faults_test.cpp calls, but that are defined in other files. They use the same device as its own
// tests, so that the pipelines are made only once.
void checkFarDevice(Faulty& faulty);       ///< defined in vulkan_far_test.cpp
void checkMeshesThatStay(Faulty& faulty);  ///< defined in vulkan_resident_faults_test.cpp

}  // namespace sgm

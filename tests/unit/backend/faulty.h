#pragma once
// A backend on a lent device whose calls fail when told, and what it has left there.

#include <filesystem>
#include <memory>

#include "kept_pipelines.h"
#include "unit/vulkan/faults.h"
#include "vulkan_machine.h"

namespace sgm {

/// To open the device anew is to begin anew on an engine's device, which takes no time.
struct Faulty : vulkan::KeptEngine {
  vulkan::Faults faults;

  Faulty() : KeptEngine(vulkan::Validation::core) {}  // of synchronization see VulkanMachine::silent

  vulkan::BorrowedDevice lend() {
    vulkan::BorrowedDevice lent = engine.lend();
    lent.replace_calls = [](vulkan::DeviceTable& table) {
      vulkan::KeptPipelines::wrap(table);
      vulkan::Faults::wrap(table);
    };
    return lent;
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

// Tests in files of their own, on the one device: it makes their pipelines once.
void checkFarDevice(Faulty& faulty);       ///< vulkan_far_test.cpp
void checkMeshesThatStay(Faulty& faulty);  ///< vulkan_resident_faults_test.cpp

}  // namespace sgm

#pragma once
// Pipelines that outlive the device that is lent, for tests.

#include <map>
#include <string>

#include "backend/vulkan/tables.h"

namespace sgm::vulkan {

/// Pipelines of one device that are made once, for all that are opened on it: software Vulkan takes seconds for each.
/// As Faults: statics, one at a time.
class KeptPipelines {
 public:
  static void wrap(DeviceTable& table) {
    State& s = state();
    s.calls = table;
    table.vkCreateShaderModule = [](VkDevice device, const VkShaderModuleCreateInfo* info,
                                    const VkAllocationCallbacks* allocator, VkShaderModule* module) {
      // The pipeline comes next (Pipeline::makePipeline).
      state().code.assign(reinterpret_cast<const char*>(info->pCode), info->codeSize);
      return state().calls.vkCreateShaderModule(device, info, allocator, module);
    };
    table.vkCreateComputePipelines = [](VkDevice device, VkPipelineCache cache, uint32_t count,
                                        const VkComputePipelineCreateInfo* info, const VkAllocationCallbacks* allocator,
                                        VkPipeline* pipeline) {
      const VkSpecializationInfo& constants = *info->stage.pSpecializationInfo;
      const std::string bytes(static_cast<const char*>(constants.pData), constants.dataSize);
      VkPipeline& kept = state().made[state().code + bytes];
      VkResult result = VK_SUCCESS;
      if (!kept) result = state().calls.vkCreateComputePipelines(device, cache, count, info, allocator, &kept);
      *pipeline = kept;
      return result;
    };
    table.vkDestroyPipeline = [](VkDevice, VkPipeline, const VkAllocationCallbacks*) {};
  }
  static void destroyAll(VkDevice device) {
    for (const auto& [key, pipeline] : state().made) state().calls.vkDestroyPipeline(device, pipeline, nullptr);
    state().made.clear();
  }

 private:
  struct State {
    DeviceTable calls;
    std::string code;
    std::map<std::string, VkPipeline> made;
  };
  static State& state() {
    static State one;
    return one;
  }
};

}  // namespace sgm::vulkan

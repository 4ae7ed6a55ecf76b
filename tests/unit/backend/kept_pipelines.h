#pragma once
// Caches pipelines beyond the lifetime of the borrowed device object, for tests.

#include <map>
#include <mutex>
#include <string>

#include "unit/vulkan/engine.h"

namespace sgm::vulkan {

/// The pipelines of one device. Each is made only once for all device objects that borrow the device, because software
/// Vulkan takes seconds to make a pipeline. The state is static, so only one KeptPipelines may exist at a time; any
/// thread may make pipelines.
class KeptPipelines {
 public:
  static void wrap(DeviceTable& table) {
    const std::scoped_lock lock(state().mutex);
    state().calls = table;
    table.vkCreateShaderModule = createModule;
    table.vkDestroyShaderModule = destroyModule;
    table.vkCreateComputePipelines = createPipeline;
    table.vkDestroyPipeline = [](VkDevice, VkPipeline, const VkAllocationCallbacks*) {};
  }
  static void destroyAll(VkDevice device) {
    const std::scoped_lock lock(state().mutex);
    for (const auto& [key, pipeline] : state().made) state().calls.vkDestroyPipeline(device, pipeline, nullptr);
    state().made.clear();
  }

 private:
  struct State {
    std::mutex mutex;
    DeviceTable calls;
    std::map<VkShaderModule, std::string> code;
    std::map<std::string, VkPipeline> made;  ///< key: the shader's code and its specialization constants
  };
  static State& state() {
    static State one;
    return one;
  }

  static VKAPI_ATTR VkResult VKAPI_CALL createModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                                     const VkAllocationCallbacks* allocator, VkShaderModule* module) {
    const std::scoped_lock lock(state().mutex);
    const VkResult result = state().calls.vkCreateShaderModule(device, info, allocator, module);
    if (result == VK_SUCCESS) {
      state().code[*module].assign(reinterpret_cast<const char*>(info->pCode), info->codeSize);
    }
    return result;
  }
  static VKAPI_ATTR void VKAPI_CALL destroyModule(VkDevice device, VkShaderModule module,
                                                  const VkAllocationCallbacks* allocator) {
    const std::scoped_lock lock(state().mutex);
    state().code.erase(module);
    state().calls.vkDestroyShaderModule(device, module, allocator);
  }
  /// If two threads request the same pipeline concurrently, the second waits until the first has made it.
  static VKAPI_ATTR VkResult VKAPI_CALL createPipeline(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                       const VkComputePipelineCreateInfo* info,
                                                       const VkAllocationCallbacks* allocator, VkPipeline* pipeline) {
    const std::scoped_lock lock(state().mutex);
    const VkSpecializationInfo& constants = *info->stage.pSpecializationInfo;
    const std::string bytes(static_cast<const char*>(constants.pData), constants.dataSize);
    VkPipeline& kept = state().made[state().code.at(info->stage.module) + bytes];
    VkResult result = VK_SUCCESS;
    if (!kept) result = state().calls.vkCreateComputePipelines(device, cache, count, info, allocator, &kept);
    *pipeline = kept;
    return result;
  }
};

/// An engine whose device keeps its pipelines until the engine is destroyed.
struct KeptEngine {
  Engine engine;

  explicit KeptEngine(Validation validation = Validation::synchronization) : engine(validation) {}
  ~KeptEngine() { KeptPipelines::destroyAll(engine.device); }
};

}  // namespace sgm::vulkan

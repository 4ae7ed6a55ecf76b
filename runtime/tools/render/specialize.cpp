#include "tools/render/specialize.h"

#include <new>
#include <spirv-tools/optimizer.hpp>
#include <string>
#include <unordered_map>

namespace sgm {

Result<std::vector<uint32_t>> specialized(std::span<const uint32_t> code, uint32_t constant) {
  try {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    std::string wrong;
    optimizer.SetMessageConsumer(
        [&wrong](spv_message_level_t level, const char*, const spv_position_t&, const char* message) {
          if (level <= SPV_MSG_ERROR && wrong.empty()) wrong = message;
        });
    optimizer
        .RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(
            std::unordered_map<uint32_t, std::vector<uint32_t>>{{0, {constant}}}))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPass(spvtools::CreateCCPPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
    spvtools::OptimizerOptions options;
    // Validation is unnecessary here: the code is from glslang, and the tests run it with the validation layer.
    options.set_run_validator(false);
    std::vector<uint32_t> made;
    if (!optimizer.Run(code.data(), code.size(), &made, options)) {
      return Error{Code::unsupported,
                   "the shader of surfaces cannot be specialized: " + wrong + "; this is a bug in sgm"};
    }
    return made;
  } catch (const std::bad_alloc&) {
    return Error{Code::out_of_memory, "not enough memory to specialize the shader of surfaces"};
  }
}

}  // namespace sgm

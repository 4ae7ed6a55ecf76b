#pragma once
// Creates compute pipelines.

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "backend/vulkan/device.h"

namespace sgm::vulkan {

class PipelineCache;

struct PipelineDesc {
  const char* name = "";  ///< name of the shader in error messages
  std::span<const uint32_t> spirv;
  uint32_t buffers = 0;                 ///< number of storage buffers in set 0 (bindings 0, 1, 2...), up to kMaxBuffers
  uint32_t push_bytes = 0;              ///< size of the push constants: a multiple of 4, at most 128
  std::span<const uint32_t> constants;  ///< values of the specialization constants 0, 1, 2..., one word each
};

inline constexpr uint32_t kMaxBuffers = 16;

/// A compute pipeline with its layouts; the shader's entry point is "main". The device must outlive the pipeline, and
/// the pipeline must outlive the commands that use it.
class Pipeline {
 public:
  /// Creates a pipeline, which may take seconds for a large shader. cache may be null. Thread-safe. Errors:
  /// invalid_argument (the description exceeds a limit of the device or of this class), out_of_memory, unsupported.
  static Result<Pipeline> create(Device& device, const PipelineDesc& desc, const PipelineCache* cache = nullptr);
  Pipeline(Pipeline&& other) noexcept;
  Pipeline& operator=(Pipeline&&) = delete;
  ~Pipeline();

  VkPipeline handle() const { return pipeline_; }
  VkPipelineLayout layout() const { return layout_; }
  VkDescriptorSetLayout setLayout() const { return set_layout_; }
  uint32_t buffers() const { return buffers_; }
  uint32_t pushBytes() const { return push_bytes_; }

 private:
  explicit Pipeline(Device& device) : device_(device) {}
  VkResult makeLayouts();
  VkResult makePipeline(const PipelineDesc& desc, VkPipelineCache cache);

  Device& device_;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  uint32_t buffers_ = 0, push_bytes_ = 0;
};

}  // namespace sgm::vulkan

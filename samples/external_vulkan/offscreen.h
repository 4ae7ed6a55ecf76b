#pragma once
// The target into which the engine draws instead of a window (a colour and a depth image), and the pipeline for
// streamed meshes.

#include <sgm/sgm.h>
#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <span>
#include <vector>

#include "draw_list.h"
#include "picture.h"
#include "spirv/cave_frag.h"
#include "spirv/cave_vert.h"
#include "view_point.h"
#include "vulkan_call.h"
#include "vulkan_memory.h"

constexpr VkFormat kColour = VK_FORMAT_R8G8B8A8_SRGB, kDepth = VK_FORMAT_D32_SFLOAT;

/// The pipeline that draws DrawLists into pictures of one size.
class ChunkPipeline {
 public:
  ChunkPipeline(VkDevice device, VkExtent2D size) : size_(size) {
    makePass(device);
    VkPushConstantRange matrix{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Matrix)};
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &matrix;
    layout_ = MAKE_VULKAN(PipelineLayout, device, layout);
    makePipeline(device);
  }

  VkExtent2D size() const { return size_; }
  VkRenderPass pass() const { return pass_.get(); }
  VkPipeline get() const { return pipeline_.get(); }
  VkPipelineLayout layout() const { return layout_.get(); }

 private:
  void makePass(VkDevice device) {
    VkAttachmentDescription colour{};
    colour.format = kColour;
    colour.samples = VK_SAMPLE_COUNT_1_BIT;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    colour.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    colour.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    colour.finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    VkAttachmentDescription depth = colour;
    depth.format = kDepth;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    const std::array attachments{colour, depth};
    const VkAttachmentReference to_colour{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference to_depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &to_colour;
    subpass.pDepthStencilAttachment = &to_depth;
    // This dependency lets the copy to the host start only after the picture is drawn.
    VkSubpassDependency copied{};
    copied.srcSubpass = 0;
    copied.dstSubpass = VK_SUBPASS_EXTERNAL;
    copied.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    copied.dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT;
    copied.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    copied.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 1;
    info.pDependencies = &copied;
    pass_ = MAKE_VULKAN(RenderPass, device, info);
  }

  static Owned<VkShaderModule, vkDestroyShaderModule> shader(VkDevice device, std::span<const uint32_t> words) {
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    return MAKE_VULKAN(ShaderModule, device, info);
  }

  void makePipeline(VkDevice device) {
    const auto vertex = shader(device, sgm::spirv::kCaveVert), fragment = shader(device, sgm::spirv::kCaveFrag);
    VkPipelineShaderStageCreateInfo stages[2]{};
    for (VkPipelineShaderStageCreateInfo& stage : stages) {
      stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
      stage.pName = "main";
    }
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[0].module = vertex.get();
    stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    stages[1].module = fragment.get();
    // Binding 0: vertices in the library's format. Binding 1: one ChunkRecord for each chunk.
    const VkVertexInputBindingDescription bindings[] = {{0, sizeof(sgm_vertex), VK_VERTEX_INPUT_RATE_VERTEX},
                                                        {1, sizeof(ChunkRecord), VK_VERTEX_INPUT_RATE_INSTANCE}};
    const VkVertexInputAttributeDescription attributes[] = {
        {0, 0, VK_FORMAT_R16G16B16A16_SINT, offsetof(sgm_vertex, x)},  // x, y, z, material
        {1, 0, VK_FORMAT_R16G16_SNORM, offsetof(sgm_vertex, normal_x)},
        {2, 1, VK_FORMAT_R32G32B32A32_SINT, 0}};
    static_assert(offsetof(sgm_vertex, material) == offsetof(sgm_vertex, x) + 6 && sizeof(ChunkRecord) == 16);
    VkPipelineVertexInputStateCreateInfo input{};
    input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    input.vertexBindingDescriptionCount = static_cast<uint32_t>(std::size(bindings));
    input.pVertexBindingDescriptions = bindings;
    input.vertexAttributeDescriptionCount = static_cast<uint32_t>(std::size(attributes));
    input.pVertexAttributeDescriptions = attributes;
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    const VkViewport viewport{0, 0, static_cast<float>(size_.width), static_cast<float>(size_.height), 0, 1};
    const VkRect2D all{{0, 0}, size_};
    VkPipelineViewportStateCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    view.viewportCount = view.scissorCount = 1;
    view.pViewports = &viewport;
    view.pScissors = &all;
    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.cullMode = VK_CULL_MODE_BACK_BIT;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_GREATER;  // reversed depth: 1 is near, 0 is infinity
    VkPipelineColorBlendAttachmentState opaque{};
    opaque.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = 1;
    blend.pAttachments = &opaque;
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = static_cast<uint32_t>(std::size(stages));
    info.pStages = stages;
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &view;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.layout = layout_.get();
    info.renderPass = pass_.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    must(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline), "vkCreateGraphicsPipelines");
    pipeline_ = {device, pipeline};
  }

  VkExtent2D size_;
  Owned<VkRenderPass, vkDestroyRenderPass> pass_;
  Owned<VkPipelineLayout, vkDestroyPipelineLayout> layout_;
  Owned<VkPipeline, vkDestroyPipeline> pipeline_;
};

/// A picture that the device draws and then copies to the host.
class Offscreen {
 public:
  Offscreen(const VulkanDevice& device, const ChunkPipeline& pipeline)
      : size_(pipeline.size()),
        colour_(device, size_, kColour, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                VK_IMAGE_ASPECT_COLOR_BIT),
        depth_(device, size_, kDepth, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT),
        back_(device, VkDeviceSize{4} * size_.width * size_.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT) {
    const VkImageView views[] = {colour_.view(), depth_.view()};
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = pipeline.pass();
    info.attachmentCount = 2;
    info.pAttachments = views;
    info.width = size_.width;
    info.height = size_.height;
    info.layers = 1;
    frame_ = MAKE_VULKAN(Framebuffer, device.handle(), info);
  }

  void begin(VkCommandBuffer commands, const ChunkPipeline& pipeline) const {
    const VkClearValue clear[2]{};  // colour: black with alpha 0, which Picture::uncovered() counts; depth: infinity
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = pipeline.pass();
    info.framebuffer = frame_.get();
    info.renderArea = {{0, 0}, size_};
    info.clearValueCount = 2;
    info.pClearValues = clear;
    vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  }

  void end(VkCommandBuffer commands) const {
    vkCmdEndRenderPass(commands);
    VkBufferImageCopy whole{};
    whole.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    whole.imageExtent = {size_.width, size_.height, 1};
    vkCmdCopyImageToBuffer(commands, colour_.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, back_.get(), 1, &whole);
    VkMemoryBarrier read{};
    read.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    read.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    read.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &read, 0, nullptr,
                         0, nullptr);
  }

  /// Returns the picture; valid once the device has completed the frame.
  Picture picture() const {
    Picture picture{size_.width, size_.height, std::vector<uint8_t>(back_.size())};
    std::memcpy(picture.rgba.data(), back_.data(), back_.size());
    return picture;
  }

 private:
  VkExtent2D size_;
  DeviceImage colour_, depth_;
  HostBuffer back_;
  Owned<VkFramebuffer, vkDestroyFramebuffer> frame_;
};

#include "tools/render/pipeline.h"

#include <array>
#include <cstddef>
#include <glm/mat4x4.hpp>

#include "spirv/foliage_frag.h"
#include "spirv/foliage_vert.h"
#include "spirv/shade_comp.h"
#include "spirv/sprout_frag.h"
#include "spirv/sprout_vert.h"
#include "spirv/surface_frag.h"
#include "spirv/surface_vert.h"
#include "tools/render/foliage.h"
#include "tools/render/scene.h"
#include "tools/render/specialize.h"

namespace sgm {
namespace {

constexpr VkFormat kPositionFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kNormalFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

constexpr std::array kShadeTypes{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                 VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                 VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                 VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

Result<VkRenderPass> makeRenderPass(VulkanScope& scope) {
  const std::array attachments{
      clearedAttachment(kPositionFormat, VK_ATTACHMENT_STORE_OP_STORE, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL),
      clearedAttachment(kNormalFormat, VK_ATTACHMENT_STORE_OP_STORE, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL),
      clearedAttachment(kDepthFormat, VK_ATTACHMENT_STORE_OP_DONT_CARE,
                        VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL)};
  const std::array<VkAttachmentReference, 2> colours{
      {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}, {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}}};
  const VkAttachmentReference depth{2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = static_cast<uint32_t>(colours.size());
  subpass.pColorAttachments = colours.data();
  subpass.pDepthStencilAttachment = &depth;
  VkSubpassDependency then_shade{};
  then_shade.srcSubpass = 0;
  then_shade.dstSubpass = VK_SUBPASS_EXTERNAL;
  then_shade.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  then_shade.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  then_shade.dstStageMask = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
  then_shade.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
  VkRenderPassCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = static_cast<uint32_t>(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = 1;
  info.pDependencies = &then_shade;
  return scope.renderPass(info);
}

/// Vertex input, topology and culling of a pipeline. The vertex buffer binding advances either with each vertex or with
/// each instance.
struct Drawn {
  VkVertexInputBindingDescription binding;
  std::array<VkVertexInputAttributeDescription, 6> attributes;
  VkPrimitiveTopology topology;
  VkCullModeFlags culled;
};

constexpr Drawn kTriangles{{0, sizeof(RenderVertex), VK_VERTEX_INPUT_RATE_VERTEX},
                           {{{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(RenderVertex, position)},
                             {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(RenderVertex, normal)},
                             {2, 0, VK_FORMAT_R32_UINT, offsetof(RenderVertex, material)},
                             {3, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(RenderVertex, texture)},
                             {4, 0, VK_FORMAT_R32_UINT, offsetof(RenderVertex, second)},
                             {5, 0, VK_FORMAT_R32_SFLOAT, offsetof(RenderVertex, share)}}},
                           VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
                           // Back faces are culled: a viewer in the void never sees them. For a viewer outside, culling
                           // hides the near walls of a cave, so that the inside of the cave is visible.
                           VK_CULL_MODE_BACK_BIT};

/// Sprouts (blades of grass and leaves) are drawn without culling, since both of their sides are visible.
constexpr Drawn kSprouts{{0, sizeof(Sprout), VK_VERTEX_INPUT_RATE_INSTANCE},
                         {{{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(Sprout, root)},
                           {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(Sprout, normal)},
                           {2, 0, VK_FORMAT_R32_UINT, offsetof(Sprout, material)},
                           {3, 0, VK_FORMAT_R32_UINT, offsetof(Sprout, lot)},
                           {4, 0, VK_FORMAT_R32_UINT, offsetof(Sprout, form)},
                           {5, 0, VK_FORMAT_R32_SFLOAT, offsetof(Sprout, bright)}}},
                         VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
                         VK_CULL_MODE_NONE};

/// A pipeline that draws with two given shaders into the positions, the normals and the reversed depth buffer.
Result<VkPipeline> makeMeshPipeline(VulkanScope& scope, VkRenderPass render_pass, VkPipelineLayout layout,
                                    const Drawn& drawn, std::span<const uint32_t> vertex_code,
                                    std::span<const uint32_t> fragment_code) {
  std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
  for (VkPipelineShaderStageCreateInfo& stage : stages) {
    stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    stage.pName = "main";
  }
  auto vertex = scope.shader(vertex_code);
  if (!vertex) return vertex.error();
  stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
  stages[0].module = *vertex;
  auto fragment = scope.shader(fragment_code);
  if (!fragment) return fragment.error();
  stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  stages[1].module = *fragment;

  VkPipelineVertexInputStateCreateInfo input{};
  input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  input.vertexBindingDescriptionCount = 1;
  input.pVertexBindingDescriptions = &drawn.binding;
  input.vertexAttributeDescriptionCount = static_cast<uint32_t>(drawn.attributes.size());
  input.pVertexAttributeDescriptions = drawn.attributes.data();
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = drawn.topology;
  VkPipelineViewportStateCreateInfo viewport{};
  viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewport.viewportCount = 1;
  viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{};
  raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  raster.cullMode = drawn.culled;
  raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples{};
  samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineDepthStencilStateCreateInfo depth{};
  depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  depth.depthTestEnable = VK_TRUE;
  depth.depthWriteEnable = VK_TRUE;
  depth.depthCompareOp = VK_COMPARE_OP_GREATER;  // depth is reversed: nearer is greater
  std::array<VkPipelineColorBlendAttachmentState, 2> blends{};
  for (VkPipelineColorBlendAttachmentState& blend : blends) {
    blend.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  }
  VkPipelineColorBlendStateCreateInfo blend{};
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = static_cast<uint32_t>(blends.size());
  blend.pAttachments = blends.data();
  const std::array dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{};
  dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  dynamic.dynamicStateCount = static_cast<uint32_t>(dynamic_states.size());
  dynamic.pDynamicStates = dynamic_states.data();

  VkGraphicsPipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.stageCount = static_cast<uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = layout;
  info.renderPass = render_pass;
  return scope.graphicsPipeline(info);
}

}  // namespace

VkAttachmentDescription clearedAttachment(VkFormat format, VkAttachmentStoreOp store, VkImageLayout final_layout) {
  VkAttachmentDescription description{};
  description.format = format;
  description.samples = VK_SAMPLE_COUNT_1_BIT;
  description.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  description.storeOp = store;
  description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  description.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  description.finalLayout = final_layout;
  return description;
}

Result<VkFramebuffer> makeFramebuffer(VulkanScope& scope, VkRenderPass render_pass, std::span<const VkImageView> views,
                                      VkExtent2D extent) {
  VkFramebufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
  info.renderPass = render_pass;
  info.attachmentCount = static_cast<uint32_t>(views.size());
  info.pAttachments = views.data();
  info.width = extent.width;
  info.height = extent.height;
  info.layers = 1;
  return scope.framebuffer(info);
}

Result<SurfacePass> makeSurfacePass(VulkanScope& scope, VkExtent2D extent) {
  SurfacePass pass;
  pass.extent = extent;
  constexpr VkImageUsageFlags kPlane = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  auto positions = scope.image(extent, kPositionFormat, kPlane, VK_IMAGE_ASPECT_COLOR_BIT);
  if (!positions) return positions.error();
  pass.positions = *positions;
  auto normals = scope.image(extent, kNormalFormat, kPlane, VK_IMAGE_ASPECT_COLOR_BIT);
  if (!normals) return normals.error();
  pass.normals = *normals;
  auto depth =
      scope.image(extent, kDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT);
  if (!depth) return depth.error();
  auto render_pass = makeRenderPass(scope);
  if (!render_pass) return render_pass.error();
  pass.render_pass = *render_pass;
  const std::array views{pass.positions.view, pass.normals.view, depth->view};
  auto framebuffer = makeFramebuffer(scope, pass.render_pass, views, extent);
  if (!framebuffer) return framebuffer.error();
  pass.framebuffer = *framebuffer;
  auto layout = scope.pipelineLayout(VK_NULL_HANDLE, kSurfaceStages, sizeof(FoliageConstants));
  if (!layout) return layout.error();
  pass.layout = *layout;
  auto draw =
      makeMeshPipeline(scope, pass.render_pass, pass.layout, kTriangles, spirv::kSurfaceVert, spirv::kSurfaceFrag);
  if (!draw) return draw.error();
  pass.draw = *draw;
  auto foliage =
      makeMeshPipeline(scope, pass.render_pass, pass.layout, kTriangles, spirv::kFoliageVert, spirv::kFoliageFrag);
  if (!foliage) return foliage.error();
  pass.foliage = *foliage;
  auto sprouts =
      makeMeshPipeline(scope, pass.render_pass, pass.layout, kSprouts, spirv::kSproutVert, spirv::kSproutFrag);
  if (!sprouts) return sprouts.error();
  pass.sprouts = *sprouts;
  return pass;
}

Result<ShadePipeline> makeShadePipeline(VulkanScope& scope, uint32_t patterns) {
  ShadePipeline made;
  made.patterns = patterns;
  auto set_layout = scope.setLayout(kShadeTypes, VK_SHADER_STAGE_COMPUTE_BIT);
  if (!set_layout) return set_layout.error();
  made.set_layout = *set_layout;
  auto layout = scope.pipelineLayout(made.set_layout, VK_SHADER_STAGE_COMPUTE_BIT, 0);
  if (!layout) return layout.error();
  made.layout = *layout;
  const auto code = specialized(spirv::kShadeComp, patterns);
  if (!code) return code.error();
  auto shader = scope.shader(*code);
  if (!shader) return shader.error();
  auto pipeline = scope.computePipeline(*shader, made.layout);
  if (!pipeline) return pipeline.error();
  made.pipeline = *pipeline;
  return made;
}

Result<VkDescriptorSet> makeShadeSet(VulkanScope& scope, const ShadePipeline& pipeline, const SurfacePass& surfaces,
                                     const ShadeBuffers& buffers) {
  auto set = scope.descriptorSet(pipeline.set_layout, kShadeTypes);
  if (!set) return set.error();
  auto sampler = scope.sampler();
  if (!sampler) return sampler.error();

  const std::array<VkDescriptorImageInfo, 2> images{
      {{*sampler, surfaces.positions.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
       {*sampler, surfaces.normals.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}}};
  const std::array<VkDescriptorBufferInfo, 6> infos{{{buffers.direct.handle, 0, VK_WHOLE_SIZE},
                                                     {buffers.frame.handle, 0, VK_WHOLE_SIZE},
                                                     {buffers.materials.handle, 0, VK_WHOLE_SIZE},
                                                     {buffers.pixels.handle, 0, VK_WHOLE_SIZE},
                                                     {buffers.soft.handle, 0, VK_WHOLE_SIZE},
                                                     {buffers.vapour.handle, 0, VK_WHOLE_SIZE}}};
  std::array<VkWriteDescriptorSet, kShadeTypes.size()> writes{};
  for (uint32_t i = 0; i < writes.size(); ++i) {
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstSet = *set;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = kShadeTypes[i];
    if (i < images.size()) {
      writes[i].pImageInfo = &images[i];
    } else {
      writes[i].pBufferInfo = &infos[i - images.size()];
    }
  }
  const VulkanDevice& device = scope.device();
  device.calls().vkUpdateDescriptorSets(device.handle(), static_cast<uint32_t>(writes.size()), writes.data(), 0,
                                        nullptr);
  return *set;
}

}  // namespace sgm

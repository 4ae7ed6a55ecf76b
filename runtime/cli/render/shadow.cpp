#include "render/shadow.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render/pipeline.h"
#include "spirv/shadow_vert.h"

namespace sgm {
namespace {

constexpr VkFormat kShadowFormat = VK_FORMAT_D32_SFLOAT;

// Looks from `eye` along one axis; x and y of the tile are the other two axes, as shadow.glsl has them.
glm::mat4 lookAlong(glm::vec3 eye, int face) {
  const int axis = face / 2, across = axis == 0 ? 2 : 0, along = axis == 1 ? 2 : 1;
  const float sign = face % 2 == 0 ? 1.0f : -1.0f;
  // Turned so that no tile is mirrored, and fronts stay fronts.
  const float turned = (axis == 2) == (sign > 0) ? 1.0f : -1.0f;
  glm::mat4 m(0);
  m[across][0] = turned;
  m[3][0] = -turned * eye[across];
  m[along][1] = 1;
  m[3][1] = -eye[along];
  m[3][2] = kLampNear;
  m[axis][3] = sign;
  m[3][3] = -sign * eye[axis];
  return m;
}

void planLamp(const RenderScene& scene, const Frame& frame, uint32_t lamp, ShadowPlan& plan) {
  const glm::vec3 eye(frame.lamp_position[lamp]);
  const float range = kLampRange * frame.lamp_position[lamp].w;
  const auto first = static_cast<uint32_t>(plan.indices.size());
  const auto near = [&](uint32_t index) {
    const glm::vec3 d = scene.vertices[index].position - eye;
    return glm::dot(d, d) < range * range;
  };
  for (size_t i = 0; i < scene.indices.size(); i += 3) {
    const uint32_t a = scene.indices[i], b = scene.indices[i + 1], c = scene.indices[i + 2];
    if (near(a) || near(b) || near(c)) plan.indices.insert(plan.indices.end(), {a, b, c});
  }
  const auto count = static_cast<uint32_t>(plan.indices.size()) - first;
  for (uint32_t face = 0; face < 6; ++face) {
    const VkOffset2D corner{static_cast<int32_t>(face * kLampTile), static_cast<int32_t>(lamp * kLampTile)};
    plan.tiles.push_back({{corner, {kLampTile, kLampTile}}, lookAlong(eye, static_cast<int>(face)), first, count});
  }
}

}  // namespace

ShadowPlan planShadows(const RenderScene& scene, const Frame& frame, std::pmr::memory_resource* memory) {
  ShadowPlan plan{{}, {}, std::pmr::vector<uint32_t>(memory)};
  if (scene.background == Background::sky) {
    plan.extent = {kSunTile, kSunTile};
    plan.indices.assign(scene.indices.begin(), scene.indices.end());
    const auto count = static_cast<uint32_t>(plan.indices.size());
    plan.tiles.push_back({{{0, 0}, plan.extent}, frame.sun_view_projection, 0, count});
    return plan;
  }
  plan.extent = {6 * kLampTile, frame.counts.x * kLampTile};
  for (uint32_t lamp = 0; lamp < frame.counts.x; ++lamp) planLamp(scene, frame, lamp, plan);
  return plan;
}

Result<ShadowPass> makeShadowPass(VulkanScope& scope, VkExtent2D extent) {
  ShadowPass pass;
  auto depth =
      scope.image(extent, kShadowFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                  VK_IMAGE_ASPECT_DEPTH_BIT);
  if (!depth) return depth.error();
  pass.depth = *depth;
  const VkAttachmentDescription attachment =
      clearedAttachment(kShadowFormat, VK_ATTACHMENT_STORE_OP_STORE, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL);
  const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.pDepthStencilAttachment = &reference;
  VkSubpassDependency then_shade{};
  then_shade.srcSubpass = 0;
  then_shade.dstSubpass = VK_SUBPASS_EXTERNAL;
  then_shade.srcStageMask = VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  then_shade.srcAccessMask = VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  then_shade.dstStageMask = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
  then_shade.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
  VkRenderPassCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = 1;
  info.pAttachments = &attachment;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = 1;
  info.pDependencies = &then_shade;
  auto render_pass = scope.renderPass(info);
  if (!render_pass) return render_pass.error();
  pass.render_pass = *render_pass;
  const std::array views{pass.depth.view};
  auto framebuffer = makeFramebuffer(scope, pass.render_pass, views, extent);
  if (!framebuffer) return framebuffer.error();
  pass.framebuffer = *framebuffer;
  auto layout = scope.pipelineLayout(VK_NULL_HANDLE, VK_SHADER_STAGE_VERTEX_BIT, sizeof(glm::mat4));
  if (!layout) return layout.error();
  pass.layout = *layout;
  // As for the eye, a wall is open from its back: a lamp outside a cave shines into the doll's house.
  auto draw = makeMeshPipeline(scope, pass.render_pass, pass.layout, spirv::kShadowVert, {});
  if (!draw) return draw.error();
  pass.draw = *draw;
  return pass;
}

void recordShadows(const DrawingTable& calls, VkCommandBuffer commands, const ShadowPlan& plan, const ShadowPass& pass,
                   const VulkanBuffer& vertices, const VulkanBuffer& indices) {
  const VkClearValue clear{};  // reversed depth: 0 is infinity
  VkRenderPassBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  begin.renderPass = pass.render_pass;
  begin.framebuffer = pass.framebuffer;
  begin.renderArea.extent = plan.extent;
  begin.clearValueCount = 1;
  begin.pClearValues = &clear;
  calls.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  calls.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pass.draw);
  const VkDeviceSize offset = 0;
  calls.vkCmdBindVertexBuffers(commands, 0, 1, &vertices.handle, &offset);
  calls.vkCmdBindIndexBuffer(commands, indices.handle, 0, VK_INDEX_TYPE_UINT32);
  for (const ShadowTile& tile : plan.tiles) {
    if (tile.index_count == 0) continue;
    const VkViewport viewport{static_cast<float>(tile.area.offset.x),
                              static_cast<float>(tile.area.offset.y),
                              static_cast<float>(tile.area.extent.width),
                              static_cast<float>(tile.area.extent.height),
                              0,
                              1};
    calls.vkCmdSetViewport(commands, 0, 1, &viewport);
    calls.vkCmdSetScissor(commands, 0, 1, &tile.area);
    calls.vkCmdPushConstants(commands, pass.layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(glm::mat4),
                             &tile.view_projection);
    calls.vkCmdDrawIndexed(commands, tile.index_count, 1, tile.first_index, 0, 0);
  }
  calls.vkCmdEndRenderPass(commands);
}

}  // namespace sgm

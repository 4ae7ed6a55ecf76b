#include "tools/render/volume_pass.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/geometric.hpp>

#include "spirv/compose_comp.h"
#include "spirv/light_comp.h"
#include "spirv/march_comp.h"
#include "tools/render/frame.h"
#include "tools/render/lens.h"

namespace sgm {
namespace {

constexpr uint32_t kBrick = 8;                      // cells along an edge of a brick; the same as in
                                                    // shaders/volume/volume.glsl
constexpr uint32_t kPixelGroup = 8, kLitGroup = 4;  // invocations along an edge of a workgroup, for pixels and for
                                                    // lattice points

constexpr VkFormat kLitFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

struct VolumeFrame {
  glm::vec4 eye, forward, right, up, sun, corner, sun_light, sky_light, ground_light;
  glm::uvec4 size, lit_size, picture;
};
static_assert(sizeof(VolumeFrame) == 12 * 16);

VolumeFrame frameOf(const VolumeScene& scene, VkExtent3D lit) {
  const CameraAxes axes = axesOf(scene.camera);
  VolumeFrame frame{};
  frame.eye = glm::vec4(scene.camera.position, scene.exposure);
  frame.forward = glm::vec4(axes.forward, scene.fog_distance);
  frame.right = glm::vec4(axes.right * axes.half_width, scene.medium.extinction);
  frame.up = glm::vec4(axes.up * axes.half_height, scene.medium.albedo);
  frame.sun = glm::vec4(glm::normalize(scene.sun_direction), scene.medium.forward);
  frame.corner = glm::vec4(scene.corner, scene.spacing);
  frame.sun_light = glm::vec4(scene.sun_light, 0);
  frame.sky_light = glm::vec4(scene.sky_light, 0);
  frame.ground_light = glm::vec4(scene.ground_light, 0);
  frame.size = glm::uvec4(scene.size, scene.medium.octaves);
  frame.lit_size = glm::uvec4(lit.width, lit.height, lit.depth, 0);
  frame.picture = glm::uvec4(scene.camera.width, scene.camera.height, scene.supersample, 0);
  return frame;
}

/// For each brick of cells: 1 if a point in the brick or on its faces has density, otherwise 0.
std::vector<uint32_t> bricksOf(const VolumeScene& scene) {
  const glm::uvec3 count = (scene.size - 2u) / kBrick + 1u;
  std::vector<uint32_t> bricks(size_t{count.x} * count.y * count.z);
  const auto holds = [&](glm::uvec3 brick) {
    const glm::uvec3 lo = brick * kBrick, hi = glm::min(lo + kBrick, scene.size - 1u);
    for (uint32_t z = lo.z; z <= hi.z; ++z) {
      for (uint32_t y = lo.y; y <= hi.y; ++y) {
        const auto row = scene.density.subspan((size_t{z} * scene.size.y + y) * scene.size.x + lo.x, hi.x - lo.x + 1);
        if (std::ranges::any_of(row, [](uint8_t density) { return density != 0; })) return true;
      }
    }
    return false;
  };
  size_t i = 0;
  for (uint32_t z = 0; z < count.z; ++z) {
    for (uint32_t y = 0; y < count.y; ++y) {
      for (uint32_t x = 0; x < count.x; ++x) bricks[i++] = holds({x, y, z});
    }
  }
  return bricks;
}

template <class T>
Result<VulkanBuffer> filled(VulkanScope& scope, std::span<const T> values, VkBufferUsageFlags usage) {
  auto buffer = scope.buffer(values.size_bytes(), usage);
  if (buffer) std::memcpy(buffer->data, values.data(), values.size_bytes());
  return buffer;
}

constexpr std::array kBindings{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                               VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                               VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                               VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

/// The resource of a descriptor: an image view or a buffer. The unused member is null.
struct Bound {
  VkImageView view = VK_NULL_HANDLE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkBuffer buffer = VK_NULL_HANDLE;
};

void bind(const VulkanDevice& device, VkDescriptorSet set, VkSampler sampler,
          const std::array<Bound, kBindings.size()>& bound) {
  std::array<VkDescriptorImageInfo, kBindings.size()> images{};
  std::array<VkDescriptorBufferInfo, kBindings.size()> buffers{};
  std::array<VkWriteDescriptorSet, kBindings.size()> writes{};
  for (uint32_t i = 0; i < writes.size(); ++i) {
    images[i] = {sampler, bound[i].view, bound[i].layout};
    buffers[i] = {bound[i].buffer, 0, VK_WHOLE_SIZE};
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstSet = set;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = kBindings[i];
    if (bound[i].view) writes[i].pImageInfo = &images[i];
    if (bound[i].buffer) writes[i].pBufferInfo = &buffers[i];
  }
  device.calls().vkUpdateDescriptorSets(device.handle(), static_cast<uint32_t>(writes.size()), writes.data(), 0,
                                        nullptr);
}

VkImageMemoryBarrier transition(VkImage image, VkImageLayout from, VkImageLayout to, VkAccessFlags before,
                                VkAccessFlags after) {
  VkImageMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  barrier.srcAccessMask = before;
  barrier.dstAccessMask = after;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  return barrier;
}

uint32_t groups(uint32_t count, uint32_t group) { return (count + group - 1) / group; }

}  // namespace

Result<VolumePass> makeVolumePass(VulkanScope& scope, const VolumeScene& scene) {
  VolumePass pass;
  pass.extent = {scene.size.x, scene.size.y, scene.size.z};
  // Light changes slowly within the volume, so it is computed at every second point along each axis only.
  pass.lit_extent = {scene.size.x / 2 + 1, scene.size.y / 2 + 1, scene.size.z / 2 + 1};
  pass.picture = {static_cast<uint32_t>(scene.camera.width), static_cast<uint32_t>(scene.camera.height)};
  const VkDeviceSize pixel_count = VkDeviceSize{pass.picture.width} * pass.picture.height;

  const VolumeFrame frame = frameOf(scene, pass.lit_extent);
  auto frame_buffer = filled(scope, std::span(&frame, 1), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
  if (!frame_buffer) return frame_buffer.error();
  const std::vector<uint32_t> bricks = bricksOf(scene);
  auto brick_buffer = filled(scope, std::span(bricks), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  if (!brick_buffer) return brick_buffer.error();
  auto upload = filled(scope, scene.density, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  if (!upload) return upload.error();
  auto light = scope.buffer(pixel_count * sizeof(glm::vec4), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  if (!light) return light.error();
  auto pixels = scope.buffer(pixel_count * sizeof(ExposedPixel), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  if (!pixels) return pixels.error();
  auto density =
      scope.volume(pass.extent, VK_FORMAT_R8_UNORM, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  if (!density) return density.error();
  auto lit = scope.volume(pass.lit_extent, kLitFormat, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT);
  if (!lit) return lit.error();
  pass.upload = *upload;
  pass.light = *light;
  pass.pixels = *pixels;
  pass.density = *density;
  pass.lit = *lit;

  auto set_layout = scope.setLayout(kBindings, VK_SHADER_STAGE_COMPUTE_BIT);
  if (!set_layout) return set_layout.error();
  auto layout = scope.pipelineLayout(*set_layout, VK_SHADER_STAGE_COMPUTE_BIT, 0);
  if (!layout) return layout.error();
  pass.layout = *layout;
  for (const auto& [spirv, pipeline] : {std::pair{std::span<const uint32_t>(spirv::kLightComp), &pass.light_pipeline},
                                        std::pair{std::span<const uint32_t>(spirv::kMarchComp), &pass.march},
                                        std::pair{std::span<const uint32_t>(spirv::kComposeComp), &pass.compose}}) {
    auto shader = scope.shader(spirv);
    if (!shader) return shader.error();
    auto made = scope.computePipeline(*shader, pass.layout);
    if (!made) return made.error();
    *pipeline = *made;
  }
  auto set = scope.descriptorSet(*set_layout, kBindings);
  if (!set) return set.error();
  pass.set = *set;
  auto sampler = scope.sampler(VK_FILTER_LINEAR);
  if (!sampler) return sampler.error();
  bind(scope.device(), pass.set, *sampler,
       {Bound{VK_NULL_HANDLE, VK_IMAGE_LAYOUT_UNDEFINED, frame_buffer->handle},
        Bound{density->view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_NULL_HANDLE},
        Bound{VK_NULL_HANDLE, VK_IMAGE_LAYOUT_UNDEFINED, brick_buffer->handle},
        Bound{lit->view, VK_IMAGE_LAYOUT_GENERAL, VK_NULL_HANDLE},
        Bound{lit->view, VK_IMAGE_LAYOUT_GENERAL, VK_NULL_HANDLE},
        Bound{VK_NULL_HANDLE, VK_IMAGE_LAYOUT_UNDEFINED, light->handle},
        Bound{VK_NULL_HANDLE, VK_IMAGE_LAYOUT_UNDEFINED, pixels->handle}});
  return pass;
}

void recordVolume(const DrawingTable& calls, VkCommandBuffer commands, const VolumePass& pass) {
  const std::array to_write{
      transition(pass.density.handle, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
                 VK_ACCESS_TRANSFER_WRITE_BIT),
      transition(pass.lit.handle, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, 0, VK_ACCESS_SHADER_WRITE_BIT)};
  calls.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                             VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 0, nullptr, 0,
                             nullptr, static_cast<uint32_t>(to_write.size()), to_write.data());
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = pass.extent;
  calls.vkCmdCopyBufferToImage(commands, pass.upload.handle, pass.density.handle, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                               1, &copy);
  const VkImageMemoryBarrier to_read =
      transition(pass.density.handle, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                 VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT);
  calls.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 0,
                             nullptr, 0, nullptr, 1, &to_read);

  VkMemoryBarrier written{};
  written.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  written.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  const auto then = [&](VkPipelineStageFlags stage, VkAccessFlags access) {
    written.dstAccessMask = access;
    calls.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, stage, 0, 1, &written, 0, nullptr, 0,
                               nullptr);
  };
  calls.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.layout, 0, 1, &pass.set, 0, nullptr);
  calls.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.light_pipeline);
  calls.vkCmdDispatch(commands, groups(pass.lit_extent.width, kLitGroup), groups(pass.lit_extent.height, kLitGroup),
                      groups(pass.lit_extent.depth, kLitGroup));
  then(VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT);
  const uint32_t across = groups(pass.picture.width, kPixelGroup), down = groups(pass.picture.height, kPixelGroup);
  calls.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.march);
  calls.vkCmdDispatch(commands, across, down, 1);
  then(VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT);
  calls.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pass.compose);
  calls.vkCmdDispatch(commands, across, down, 1);
  then(VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

}  // namespace sgm

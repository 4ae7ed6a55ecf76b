#include "tools/render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <new>
#include <utility>

#include "tools/render/foliage.h"
#include "tools/render/frame.h"
#include "tools/render/lens.h"
#include "tools/render/light_planes.h"
#include "tools/render/pipeline.h"

namespace sgm {
namespace {

constexpr uint32_t kGroup = 8;  // width and height in pixels of a workgroup of shade.comp

Error invalid(const std::string& message) { return {Code::invalid_argument, message}; }

Result<void> checkMesh(const RenderScene& scene) {
  if (scene.indices.size() % 3 != 0) return invalid("the number of indices must be a multiple of 3");
  if (scene.vertices.size() > UINT32_MAX || scene.indices.size() > UINT32_MAX / (kMaxLamps + 1)) {
    return Error{Code::limit, "the mesh is too large for one picture: mesh a smaller region or a coarser cell"};
  }
  const auto highest = std::ranges::max_element(scene.indices);
  if (highest != scene.indices.end() && *highest >= scene.vertices.size()) {
    return invalid("index " + std::to_string(*highest) + " is beyond the last vertex");
  }
  for (const RenderVertex& vertex : scene.vertices) {
    if (!isFinite(vertex.position) || !isFinite(vertex.normal)) return invalid("a vertex is not finite");
  }
  return {};
}

Result<void> check(const RenderScene& scene, const VkPhysicalDeviceLimits& limits) {
  if (auto camera = checkCamera(scene.camera); !camera) return camera.error();
  if (auto mesh = checkMesh(scene); !mesh) return mesh.error();
  if (scene.materials.empty()) return invalid("a scene needs at least one material");
  if (scene.lamps.size() > kMaxLamps)
    return invalid("a scene may have at most " + std::to_string(kMaxLamps) + " lamps");
  const auto dark = [](const RenderLamp& lamp) { return !(lamp.reach > 0) || !isFinite(lamp.position); };
  if (dark(scene.headlamp) || std::ranges::any_of(scene.lamps, dark)) {
    return invalid("a lamp must have a finite position and a reach above 0");
  }
  if (scene.supersample < 1 || scene.supersample > 3)
    return invalid("a pixel must have 1, 2 or 3 samples on each side");
  if (!(scene.fog_distance > 0)) return invalid("the fog's distance must be above 0");
  if (!(glm::dot(scene.sun_direction, scene.sun_direction) > 0)) return invalid("the sun's direction must not be 0");
  const uint32_t side = static_cast<uint32_t>(std::max(scene.camera.width, scene.camera.height) * scene.supersample);
  if (side > limits.maxImageDimension2D || side > limits.maxFramebufferWidth || side > limits.maxFramebufferHeight) {
    return Error{Code::unsupported, "this device cannot draw " + std::to_string(side) +
                                        " samples on a side: choose a smaller picture or less supersampling"};
  }
  return {};
}

template <class T>
Result<VulkanBuffer> upload(VulkanScope& scope, std::span<const T> values, VkBufferUsageFlags usage) {
  // Vulkan does not allow empty buffers: an empty mesh gets a buffer of four bytes.
  auto buffer = scope.buffer(std::max<VkDeviceSize>(values.size_bytes(), 4), usage);
  if (buffer && !values.empty()) std::memcpy(buffer->data, values.data(), values.size_bytes());
  return buffer;
}

/// The exposure adapts to the brightness of the picture, but only in part: a dark place stays darker than a bright one.
/// Under a sky, it is limited so that pale surfaces do not burn out if most surfaces are dark.
float exposureFor(const LightPlanes& light, Background background) {
  if (light.brightness <= 0) return 1;
  if (background == Background::sky) {
    constexpr float kWhite = 1.2f;  // brightness that is drawn just below white
    // Indoors, where visible surfaces get little light, the exposure may rise until the sky in the windows burns out.
    const float indoors = 1 - glm::smoothstep(0.20f, 0.45f, light.lit);
    const float mean = std::pow(0.20f / light.brightness, glm::mix(0.4f, 0.8f, indoors));
    return std::clamp(std::min(mean, kWhite / light.highlight), 0.6f, glm::mix(1.5f, 3.0f, indoors));
  }
  return std::clamp(std::pow(0.16f / light.brightness, 0.7f), 0.5f, 4.0f);
}

}  // namespace

static_assert(static_cast<uint32_t>(SurfacePattern::leaded) < 31, "a pattern is a bit of ShadePipeline::patterns");

/// The most recent shading pipeline, and the scope that owns it. It is reused if it supports the next scene's material
/// patterns and sky.
struct Renderer::Kept {
  std::unique_ptr<VulkanScope> scope;
  ShadePipeline shade;

  /// Makes a new shading pipeline if the current one lacks a material pattern or the sky of the scene. Errors: those of
  /// the device.
  Result<void> lightPatterns(const VulkanDevice& device, const RenderScene& scene) {
    constexpr uint32_t kSkyBit = 1u << 31;
    uint32_t patterns = scene.background == Background::sky ? kSkyBit : 0;
    for (const RenderMaterial& material : scene.materials) patterns |= 1u << static_cast<uint32_t>(material.pattern);
    if (scope && (patterns & ~shade.patterns) == 0) return {};
    scope = std::make_unique<VulkanScope>(device);
    auto made = makeShadePipeline(*scope, patterns | shade.patterns);
    if (!made) {
      scope.reset();
      return made.error();
    }
    shade = *made;
    return {};
  }
};

Renderer::Renderer(std::unique_ptr<VulkanDevice> device, std::unique_ptr<JobSystem> jobs)
    : device_(std::move(device)), jobs_(std::move(jobs)), kept_(std::make_unique<Kept>()) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Result<Renderer> Renderer::create(const GpuOptions& options) {
  auto device = VulkanDevice::create(options);
  if (!device) return device.error();
  auto jobs = makeThreadPool(0, {}, "sgm light");
  if (!jobs) return jobs.error();
  return Renderer(std::move(*device), std::move(*jobs));
}

Result<Image> Renderer::render(const RenderScene& scene) const {
  try {
    return draw(scene);
  } catch (const std::bad_alloc&) {
    return Error{Code::out_of_memory, "out of memory while drawing a picture"};
  }
}

Result<Image> Renderer::draw(const RenderScene& scene) const {
  if (auto checked = check(scene, device_->limits()); !checked) return checked.error();
  const DrawingTable& calls = device_->calls();
  VulkanScope scope(*device_);

  RenderFrame frame = frameOf(scene);
  findLand(scene, frame);
  const Result<LightPlanes> light = traceLight(scene, frame, *jobs_);
  if (!light) return light.error();
  frame.counts.z = light->vapour.empty() ? 0 : 1;
  frame.pattern_offset.w *= exposureFor(*light, scene.background);
  const std::vector<FrameMaterial> materials = frameMaterials(scene);
  auto vertex_buffer = upload(scope, scene.vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  if (!vertex_buffer) return vertex_buffer.error();
  const std::vector<uint32_t> indices = withoutCrowns(scene, frame, partsOf(scene).bodies);
  auto index_buffer = upload(scope, std::span<const uint32_t>(indices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  if (!index_buffer) return index_buffer.error();
  const Foliage foliage = foliageOf(scene, frame);
  auto ground = upload(scope, std::span<const RenderVertex>(foliage.ground), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  if (!ground) return ground.error();
  auto sprouts = upload(scope, std::span<const Sprout>(foliage.sprouts), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  if (!sprouts) return sprouts.error();
  auto frame_buffer = upload(scope, std::span<const RenderFrame>(&frame, 1), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
  if (!frame_buffer) return frame_buffer.error();
  auto material_buffer = upload(scope, std::span<const FrameMaterial>(materials), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  if (!material_buffer) return material_buffer.error();
  const uint32_t width = frame.size.x, height = frame.size.y;
  auto pixels = scope.buffer(VkDeviceSize{sizeof(ExposedPixel)} * width * height, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  if (!pixels) return pixels.error();

  auto surfaces = makeSurfacePass(scope, {width * frame.size.z, height * frame.size.z});
  if (!surfaces) return surfaces.error();
  auto direct = upload(scope, std::span<const DirectLight>(light->direct), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  if (!direct) return direct.error();
  auto soft = upload(scope, std::span<const SoftLight>(light->soft), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  if (!soft) return soft.error();
  auto vapour = upload(scope, std::span<const VapourLight>(light->vapour), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  if (!vapour) return vapour.error();
  if (auto ready = kept_->lightPatterns(*device_, scene); !ready) return ready.error();
  const ShadePipeline& shade = kept_->shade;
  auto shade_set =
      makeShadeSet(scope, shade, *surfaces, {*direct, *frame_buffer, *material_buffer, *pixels, *soft, *vapour});
  if (!shade_set) return shade_set.error();

  auto drawn = device_->run([&](VkCommandBuffer commands) {
    const std::array<VkClearValue, 3> clear{};  // zeros: alpha 0 is background, reversed depth 0 is infinity
    VkRenderPassBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = surfaces->render_pass;
    begin.framebuffer = surfaces->framebuffer;
    begin.renderArea.extent = surfaces->extent;
    begin.clearValueCount = static_cast<uint32_t>(clear.size());
    begin.pClearValues = clear.data();
    calls.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    calls.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, surfaces->draw);
    // The negative viewport height flips the picture: the scene's y axis points up, Vulkan's points down.
    const float w = static_cast<float>(surfaces->extent.width), h = static_cast<float>(surfaces->extent.height);
    const VkViewport viewport{0, h, w, -h, 0, 1};
    calls.vkCmdSetViewport(commands, 0, 1, &viewport);
    calls.vkCmdSetScissor(commands, 0, 1, &begin.renderArea);
    calls.vkCmdPushConstants(commands, surfaces->layout, kSurfaceStages, 0, sizeof(glm::mat4), &frame.view_projection);
    const VkDeviceSize offset = 0;
    calls.vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer->handle, &offset);
    calls.vkCmdBindIndexBuffer(commands, index_buffer->handle, 0, VK_INDEX_TYPE_UINT32);
    if (!indices.empty()) {
      calls.vkCmdDrawIndexed(commands, static_cast<uint32_t>(indices.size()), 1, 0, 0, 0);
    }
    calls.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, surfaces->foliage);
    calls.vkCmdPushConstants(commands, surfaces->layout, kSurfaceStages, 0, sizeof(FoliageConstants),
                             &foliage.constants);
    if (!foliage.ground.empty()) {
      calls.vkCmdBindVertexBuffers(commands, 0, 1, &ground->handle, &offset);
      calls.vkCmdDraw(commands, static_cast<uint32_t>(foliage.ground.size()), 1, 0, 0);
    }
    if (!foliage.sprouts.empty()) {
      calls.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, surfaces->sprouts);
      calls.vkCmdBindVertexBuffers(commands, 0, 1, &sprouts->handle, &offset);
      calls.vkCmdDraw(commands, kSproutCorners, static_cast<uint32_t>(foliage.sprouts.size()), 0, 0);
    }
    calls.vkCmdEndRenderPass(commands);
    calls.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, shade.pipeline);
    calls.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, shade.layout, 0, 1, &*shade_set, 0,
                                  nullptr);
    calls.vkCmdDispatch(commands, (width + kGroup - 1) / kGroup, (height + kGroup - 1) / kGroup, 1);
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    calls.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                               &barrier, 0, nullptr, 0, nullptr);
  });
  if (!drawn) return drawn.error();
  const std::span exposed(reinterpret_cast<const ExposedPixel*>(pixels->data), size_t{width} * height);
  return developed(exposed, scene.camera.width, scene.camera.height);
}

}  // namespace sgm

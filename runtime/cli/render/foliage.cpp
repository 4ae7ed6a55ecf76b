#include "render/foliage.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render/puff_noise.h"

namespace sgm {
namespace {

struct Kind {
  SurfacePattern pattern;
  uint32_t layers;
  float height;  ///< metres over the surface
  float depth;   ///< metres under it
  float far;     ///< metres
};
constexpr std::array kKinds{Kind{SurfacePattern::grassy, 14, 0.13f, 0, 45},
                            Kind{SurfacePattern::leafy, 12, 0.36f, 0.30f, 220}};
constexpr const Kind& kLeaves = kKinds[1];

bool grows(const Kind& kind, const RenderMaterial& material) {
  return material.pattern == kind.pattern && material.relief > 0;
}

bool grows(const Kind& kind, uint32_t material, const RenderScene& scene) {
  return grows(kind, scene.materials[std::min<size_t>(material, scene.materials.size() - 1)]);
}

bool isNear(const Kind& kind, const RenderVertex& corner, const Frame& frame) {
  return corner.texture == glm::vec2(0) && glm::distance(corner.position, glm::vec3(frame.eye)) <= kind.far;
}

/// As Foliage::vertices tells it: sprigs and tufts are puffs, with gaps between them.
float growthAt(const Kind& kind, glm::vec3 position, const Frame& frame) {
  const float finest = frame.eye.w * glm::distance(position, glm::vec3(frame.eye));
  const float hollow = puffHollows(position + glm::vec3(frame.pattern_offset), 0.95f, finest);
  return kind.pattern == SurfacePattern::grassy ? std::clamp(1.1f - 0.9f * hollow, 0.25f, 1.0f)
                                                : std::clamp(0.9f - 2 * hollow, -1.0f, 1.0f);
}

Foliage foliageOf(const Kind& kind, float which, const RenderScene& scene, const Frame& frame) {
  Foliage foliage;
  foliage.layers = kind.layers;
  foliage.constants.view_projection = frame.view_projection;
  foliage.constants.eye = frame.eye;
  foliage.constants.offset = glm::vec4(glm::vec3(frame.pattern_offset), kind.height);
  foliage.constants.kind = glm::vec4(which, static_cast<float>(kind.layers), kind.far, kind.depth);
  // Six triangles share a vertex on a mean: the noise, which is dear, is found once for all of them.
  constexpr float kUnknown = -2;
  std::vector<float> growth(scene.vertices.size(), kUnknown);
  for (size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
    const RenderVertex& one = scene.vertices[scene.indices[i]];
    const int grown = (grows(kind, one.material, scene) ? 1 : 0) + (grows(kind, one.second, scene) ? 2 : 0);
    if (grown == 0 || !isNear(kind, one, frame)) continue;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t index = scene.indices[i + k];
      RenderVertex vertex = scene.vertices[index];
      if (growth[index] == kUnknown) growth[index] = growthAt(kind, vertex.position, frame);
      vertex.texture = {static_cast<float>(grown), growth[index]};
      foliage.vertices.push_back(vertex);
    }
  }
  return foliage;
}

}  // namespace

std::array<Foliage, 2> foliageOf(const RenderScene& scene, const Frame& frame) {
  return {foliageOf(kKinds[0], 0, scene, frame), foliageOf(kKinds[1], 1, scene, frame)};
}

bool hasLeaves(const RenderMaterial& material) { return grows(kLeaves, material); }

bool isCrown(const RenderScene& scene, const Frame& frame, const std::array<const RenderVertex*, 3>& corners) {
  const RenderVertex& one = *corners[0];
  const auto isAlone = [](const RenderVertex* corner) { return corner->share == 0; };
  return grows(kLeaves, one.material, scene) && isNear(kLeaves, one, frame) &&
         (grows(kLeaves, one.second, scene) || std::ranges::all_of(corners, isAlone));
}

bool isCrownGap(const Frame& frame, glm::vec3 position, float facing) {
  // As reachAt() of shaders/render/foliage.frag.
  const float rim = 1 - glm::smoothstep(0.05f, 0.6f, facing);
  return growthAt(kLeaves, position, frame) < glm::mix(-0.46f, 0.0f, rim);
}

std::vector<uint32_t> withoutCrowns(const RenderScene& scene, const Frame& frame, std::span<const uint32_t> indices) {
  std::vector<uint32_t> rest;
  rest.reserve(indices.size());
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const std::span<const uint32_t> triangle = indices.subspan(i, 3);
    const auto corner = [&](size_t k) { return &scene.vertices[triangle[k]]; };
    if (!isCrown(scene, frame, {corner(0), corner(1), corner(2)}))
      rest.insert(rest.end(), triangle.begin(), triangle.end());
  }
  return rest;
}

}  // namespace sgm

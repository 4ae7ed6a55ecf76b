#include "render/foliage.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace sgm {
namespace {

struct Kind {
  SurfacePattern pattern;
  uint32_t layers;
  float height;  ///< metres
  float far;     ///< metres
};
constexpr std::array kKinds{Kind{SurfacePattern::grassy, 14, 0.11f, 45}, Kind{SurfacePattern::leafy, 14, 0.26f, 220}};

Foliage foliageOf(const Kind& kind, float which, const RenderScene& scene, const Frame& frame) {
  Foliage foliage;
  foliage.layers = kind.layers;
  foliage.constants.view_projection = frame.view_projection;
  foliage.constants.eye = frame.eye;
  foliage.constants.offset = glm::vec4(glm::vec3(frame.pattern_offset), kind.height);
  foliage.constants.kind = glm::vec4(which, static_cast<float>(kind.layers), kind.far, 0);
  const auto grows = [&](uint32_t material) {
    const RenderMaterial& one = scene.materials[std::min<size_t>(material, scene.materials.size() - 1)];
    return one.pattern == kind.pattern && one.relief > 0;
  };
  const glm::vec3 eye(frame.eye);
  for (size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
    const RenderVertex& one = scene.vertices[scene.indices[i]];
    const glm::vec2 grown(grows(one.material) ? 1 : 0, grows(one.second) ? 1 : 0);
    const bool chequered = one.texture != glm::vec2(0);
    if (chequered || grown.x + grown.y == 0 || glm::distance(one.position, eye) > kind.far) continue;
    for (size_t k = 0; k < 3; ++k) {
      RenderVertex vertex = scene.vertices[scene.indices[i + k]];
      vertex.texture = grown;
      foliage.vertices.push_back(vertex);
    }
  }
  return foliage;
}

}  // namespace

std::array<Foliage, 2> foliageOf(const RenderScene& scene, const Frame& frame) {
  return {foliageOf(kKinds[0], 0, scene, frame), foliageOf(kKinds[1], 1, scene, frame)};
}

}  // namespace sgm

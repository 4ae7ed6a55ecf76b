#include "tools/render/land.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <vector>

namespace sgm {
namespace {

// The ground is examined in a strip along the inside of the world's border. kBorder: width of this strip as a share of
// the world's width.
constexpr float kBorder = 0.06f;
constexpr float kLeast = 0.05f;  // minimum share of the border strip ahead of the camera that must be ground
constexpr float kEdge = 0.005f;  // Surfaces nearer to the world's border than this share of the world's width count as
                                 // cut off by the border.
constexpr float kAlive = 0.1f;   // if plants cover more than this share of the ground, the land gets a material with
                                 // plants
constexpr float kLevel = 0.7f;   // minimum cosine of the angle between the normal of ground and the vertical; steeper
                                 // surfaces are not ground
constexpr float kBelow = 0.3f;   // surfaces less than this many metres below the eye do not count as ground
constexpr float kAside = 0.35f;  // a place is ahead if the cosine of its horizontal angle to the view exceeds this

bool isBare(SurfacePattern pattern) {
  using enum SurfacePattern;
  return pattern == rock || pattern == speckled || pattern == flow || pattern == granular || pattern == gravelly;
}

bool isAlive(SurfacePattern pattern) {
  using enum SurfacePattern;
  return pattern == grassy || pattern == mossy || pattern == leafy;
}

/// Whether a surface with this pattern counts as ground. Water and artificial surfaces do not.
bool isGround(SurfacePattern pattern) {
  using enum SurfacePattern;
  return pattern != water && pattern != plain && pattern != glass && pattern != metallic;
}

bool isCloud(const RenderScene& scene, const RenderVertex& vertex) {
  const size_t material = std::min<size_t>(vertex.material, scene.materials.size() - 1);
  return scene.materials[material].pattern == SurfacePattern::cloud;
}

struct Patch {
  float height, area;
  uint32_t material;
};

}  // namespace

std::optional<Land> landAround(const RenderScene& scene) {
  glm::vec2 lo(std::numeric_limits<float>::max()), hi(-lo);
  for (const RenderVertex& vertex : scene.vertices) {
    const glm::vec2 at(vertex.position.x, vertex.position.z);
    lo = glm::min(lo, at);
    hi = glm::max(hi, at);
  }
  const glm::vec2 margin = kBorder * (hi - lo), inner_lo = lo + margin, inner_hi = hi - margin;
  const glm::vec3 eye = scene.camera.position, view = scene.camera.target - eye;
  const glm::vec2 level(view.x, view.z);
  if (!(margin.x > 0 && margin.y > 0) || !(glm::length(level) > 0)) return {};
  const glm::vec2 ahead = glm::normalize(level);
  const auto isAhead = [&](glm::vec2 at) {
    const glm::vec2 way = at - glm::vec2(eye.x, eye.z);
    return glm::dot(way, ahead) > kAside * glm::length(way);
  };
  const glm::vec2 edge = kEdge * (hi - lo), edge_lo = lo + edge, edge_hi = hi - edge;
  const auto isCut = [&](glm::vec3 p) {
    return p.x < edge_lo.x || p.z < edge_lo.y || p.x > edge_hi.x || p.z > edge_hi.y;
  };
  // True if the world's border cuts off the ground. A shape that ends before the border, such as a ball, does not stand
  // on land.
  bool goes_on = false;
  std::vector<Patch> patches;
  for (size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
    const RenderVertex& one = scene.vertices[scene.indices[i]];
    const glm::vec2 at(one.position.x, one.position.z);
    if (glm::all(glm::greaterThan(at, inner_lo)) && glm::all(glm::lessThan(at, inner_hi))) continue;
    if (one.position.y > eye.y - kBelow || !isAhead(at)) continue;
    const glm::vec3 b = scene.vertices[scene.indices[i + 1]].position,
                    c = scene.vertices[scene.indices[i + 2]].position;
    const glm::vec3 facing = glm::cross(b - one.position, c - one.position);
    const float size = glm::length(facing);
    if (!(size > 0) || facing.y < kLevel * size) continue;
    const auto material = std::min<size_t>(one.material, scene.materials.size() - 1);
    if (!isGround(scene.materials[material].pattern)) continue;
    goes_on |= isCut(one.position) || isCut(b) || isCut(c);
    patches.push_back({one.position.y, size / 2, static_cast<uint32_t>(material)});
  }
  // Estimate the horizontal area of the border strip ahead of the camera, on a grid of points over the world.
  constexpr int kGrid = 64;
  float border = 0;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    const glm::vec2 share((static_cast<float>(i % kGrid) + 0.5f) / kGrid,
                          (static_cast<float>(i / kGrid) + 0.5f) / kGrid);
    const glm::vec2 at = glm::mix(lo, hi, share);
    const bool inner = glm::all(glm::greaterThan(at, inner_lo)) && glm::all(glm::lessThan(at, inner_hi));
    if (!inner && isAhead(at)) border += (hi.x - lo.x) * (hi.y - lo.y) / (kGrid * kGrid);
  }
  float area = 0;
  std::vector<float> by_material(scene.materials.size());
  for (const Patch& patch : patches) {
    area += patch.area;
    by_material[patch.material] += patch.area;
  }
  if (!goes_on || !(area > kLeast * border)) return {};
  std::ranges::sort(patches, {}, &Patch::height);
  float below = 0;
  const auto median =
      std::ranges::find_if(patches, [&](const Patch& patch) { return (below += patch.area) >= area / 2; });
  Land land;
  land.height = median == patches.end() ? patches.back().height : median->height;
  std::vector<float> alive(by_material);
  for (size_t i = 0; i < alive.size(); ++i)
    if (!isAlive(scene.materials[i].pattern)) alive[i] = 0;
  const bool grows = std::accumulate(alive.begin(), alive.end(), 0.0f) > kAlive * area;
  const std::vector<float>& shares = grows ? alive : by_material;
  land.material = static_cast<uint32_t>(std::ranges::max_element(shares) - shares.begin());
  land.bare = isBare(scene.materials[land.material].pattern);
  return land;
}

std::optional<Land> landUnderClouds(const RenderScene& scene) {
  if (scene.indices.empty()) return {};
  for (const uint32_t index : scene.indices)
    if (!isCloud(scene, scene.vertices[index])) return {};
  Land land;
  land.height = static_cast<float>(-metres(scene.origin.y));
  land.material = Land::kMeadow;
  if (scene.camera.position.y < land.height + kBelow) return {};
  return land;
}

float reachOfClouds(const RenderScene& scene) {
  const glm::vec2 eye(scene.camera.position.x, scene.camera.position.z);
  float reach = 0;
  for (const uint32_t index : scene.indices) {
    const RenderVertex& vertex = scene.vertices[index];
    if (isCloud(scene, vertex))
      reach = std::max(reach, glm::distance(glm::vec2(vertex.position.x, vertex.position.z), eye));
  }
  return reach;
}

}  // namespace sgm

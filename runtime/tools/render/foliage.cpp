#include "tools/render/foliage.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tools/render/puff_noise.h"

namespace sgm {
namespace {

struct Kind {
  SurfacePattern pattern;
  float far;  ///< metres; foliage beyond this distance from the camera is not drawn
};
constexpr Kind kLawn{SurfacePattern::grassy, 70}, kLeaves{SurfacePattern::leafy, 220};

constexpr float kBladeWidth = 0.0052f;           ///< metres, width of a blade of grass near the camera
constexpr float kTallest = 0.23f;                ///< metres, length of the tallest blades of grass
constexpr float kReach = 0.15f, kDepth = 0.14f;  ///< metres, distances up to which leaves are placed outside a crown's
                                                 ///< surface (kReach) and inside it (kDepth)
constexpr float kLeafLength = 0.062f;            ///< length of a leaf in metres
constexpr float kLeastGrowth = -0.15f;           ///< leaves grow only where growthAt() is at least about this
constexpr size_t kMaxSprouts = size_t{6} << 20;  ///< maximum number of sprouts in a picture
constexpr float kSteepest = 0.72f;               ///< minimum y component of the unit normal of ground with grass:
                                                 ///< steeper ground has no grass

bool grows(const Kind& kind, const RenderMaterial& material) {
  return material.pattern == kind.pattern && material.relief > 0;
}

const RenderMaterial& materialAt(const RenderScene& scene, uint32_t material) {
  return scene.materials[std::min<size_t>(material, scene.materials.size() - 1)];
}

bool grows(const Kind& kind, uint32_t material, const RenderScene& scene) {
  return grows(kind, materialAt(scene, material));
}

bool isNear(const Kind& kind, const RenderVertex& corner, const RenderFrame& frame) {
  return corner.texture == glm::vec2(0) && glm::distance(corner.position, glm::vec3(frame.eye)) <= kind.far;
}

/// Noise that groups blades and leaves, with gaps between the groups. For a lawn: height of the blades as a share of
/// kTallest, 0.25..1. For leaves: -1..1, negative in the gaps between sprigs.
float growthAt(const Kind& kind, glm::vec3 position, const RenderFrame& frame) {
  const float finest = frame.eye.w * glm::distance(position, glm::vec3(frame.eye));
  const float hollow = puffHollows(position + glm::vec3(frame.pattern_offset), 0.95f, finest);
  return kind.pattern == SurfacePattern::grassy ? std::clamp(1.1f - 0.9f * hollow, 0.25f, 1.0f)
                                                : std::clamp(0.9f - 2 * hollow, -1.0f, 1.0f);
}

/// A random number generator that is seeded with a position, so that foliage stays fixed while the camera moves.
class Dice {
 public:
  explicit Dice(glm::vec3 place) {
    for (int axis = 0; axis < 3; ++axis)
      state_ = (state_ ^ std::bit_cast<uint32_t>(place[axis])) * 0x9E3779B1u + 0x85EBCA6Bu;
  }

  uint32_t lot() {  // xorshift (Marsaglia 2003, "Xorshift RNGs"), and a final multiplication
    state_ ^= state_ << 13u;
    state_ ^= state_ >> 17u;
    state_ ^= state_ << 5u;
    return state_ * 0x2C1B3C6Du ^ state_ >> 15u;
  }
  float next() { return static_cast<float>(lot() >> 8u) / 16777216.0f; }

 private:
  uint32_t state_ = 0x68E31DA4u;
};

class Sower {
  using vec3 = glm::vec3;

 public:
  Sower(const RenderScene& scene, const RenderFrame& frame) : scene_(scene), frame_(frame) {}

  /// Adds the blades or leaves that grow on a triangle to `sprouts`. grown: result of grownOn() for the triangle: on
  /// which of the triangle's two materials the foliage grows.
  void sow(const Kind& kind, int grown, const std::array<const RenderVertex*, 3>& corners,
           std::vector<Sprout>& sprouts) {
    const vec3 a = corners[0]->position, b = corners[1]->position - a, c = corners[2]->position - a;
    const vec3 facet = glm::cross(b, c);
    const float area = 0.5f * glm::length(facet);
    const float extent = std::max(glm::length(b), glm::length(c));
    const vec3 middle = a + (b + c) / 3.0f;
    if (area <= 0 || !isSeen(middle, extent + 0.5f)) return;
    const bool lawn = kind.pattern == SurfacePattern::grassy;
    const float nearest = std::max(0.3f, glm::distance(middle, vec3(frame_.eye)) - extent);
    const float most = lawn ? bladesAt(nearest) : leavesAt(nearest);
    Dice dice(a + vec3(frame_.pattern_offset));
    dice.lot();
    float count = area * most + dice.next();
    for (; count >= 1 && sprouts.size() < kMaxSprouts; count -= 1) {
      float u = dice.next(), v = dice.next();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const vec3 place = a + u * b + v * c;
      const float t = glm::distance(place, vec3(frame_.eye));
      if (dice.next() * most > (lawn ? bladesAt(t) : leavesAt(t))) continue;
      const auto mixed = [&](auto member) {
        return corners[0]->*member * (1 - u - v) + corners[1]->*member * u + corners[2]->*member * v;
      };
      const bool second = mixed(&RenderVertex::share) > 0.3f + 0.4f * dice.next();
      if ((grown & (second ? 2 : 1)) == 0) continue;
      vec3 normal = mixed(&RenderVertex::normal);
      const float length = glm::length(normal);
      normal = length > 0.1f ? normal / length : facet / (2 * area);
      Sprout sprout;
      sprout.root = place;
      sprout.normal = normal;
      sprout.material = second ? corners[0]->second : corners[0]->material;
      sprout.lot = dice.lot();
      lawn ? addBlade(sprout, t, dice, sprouts) : addLeaf(sprout, t, dice, sprouts);
    }
  }

 private:
  bool isSeen(vec3 place, float margin) const {
    const vec3 v = place - vec3(frame_.eye), right(frame_.right), up(frame_.up);
    const float z = glm::dot(v, vec3(frame_.forward)), wide = glm::length(right), high = glm::length(up);
    return z > -margin && std::abs(glm::dot(v, right)) <= wide * (wide * std::max(z, 0.0f) + (1 + wide) * margin) &&
           std::abs(glm::dot(v, up)) <= high * (high * std::max(z, 0.0f) + (1 + high) * margin);
  }

  float bladeWidth(float t) const { return std::max(kBladeWidth, 1.15f * frame_.eye.w * t); }
  /// Number of blades per square metre at distance t from the camera. It decreases with the distance, since distant
  /// blades are drawn wider.
  float bladesAt(float t) const {
    const float near = 5500, own = kBladeWidth / bladeWidth(t);
    return near * own * own * std::clamp((kLawn.far - t) / (0.45f * kLawn.far), 0.0f, 1.0f);
  }

  float leafLength(float t) const { return std::max(kLeafLength, 2.6f * frame_.eye.w * t); }
  float leavesAt(float t) const {
    const float length = leafLength(t);
    return 4.6f / (length * length);
  }

  void addBlade(Sprout sprout, float t, Dice& dice, std::vector<Sprout>& sprouts) const {
    if (sprout.normal.y < kSteepest + 0.06f * dice.next()) return;
    const vec3 pattern = sprout.root + vec3(frame_.pattern_offset);
    const float growth = growthAt(kLawn, sprout.root, frame_), own = dice.next();
    // Noise that decides where flowers and seed heads grow, so that they grow in groups.
    const float company = 1 - 1.6f * puffHollows(pattern + 71.0f, 7, 1), chance = dice.next();
    sprout.length = kTallest * growth * (0.35f + 0.65f * own);
    sprout.width = bladeWidth(t) * (0.75f + 0.5f * dice.next());
    sprout.bright = 0.62f + 0.62f * dice.next();
    if (chance < 0.010f * company) {
      sprout.length = kTallest * (0.7f + 0.8f * own);
      sprout.width *= 0.6f;
      sprouts.push_back(sprout);
      sprout.root += vec3(0, sprout.length, 0);
      sprout.length = std::max(0.014f + 0.010f * own, 1.8f * frame_.eye.w * t);
      sprout.form = dice.next() < 0.55f ? SproutForm::white_blossom : SproutForm::yellow_blossom;
    } else if (chance > 1 - 0.012f * std::max(0.1f, 0.5f - company)) {
      sprout.form = SproutForm::dry_blade;
      sprout.length = kTallest * (1.2f + 1.3f * own);
      sprout.width *= 0.7f;
    }
    sprouts.push_back(sprout);
  }

  void addLeaf(Sprout sprout, float t, Dice& dice, std::vector<Sprout>& sprouts) const {
    const float deep = dice.next();
    sprout.root += sprout.normal * (kReach * deep - kDepth * (1 - deep));
    const float growth = growthAt(kLeaves, sprout.root, frame_);
    // A distant crown is drawn as a solid body of fewer, larger leaves.
    const float far = glm::smoothstep(1.0f, 2.5f, leafLength(t) / kLeafLength);
    // A crown has fewer leaves at its silhouette than in the middle.
    const vec3 to_eye = (vec3(frame_.eye) - sprout.root) / t;
    const float rim = 1 - glm::smoothstep(0.1f, 0.7f, std::abs(glm::dot(sprout.normal, to_eye)));
    if (growth < kLeastGrowth + 0.35f * (rim - 0.6f) - 0.35f * far + 0.5f * dice.next() * dice.next()) return;
    const float broad = materialAt(scene_, sprout.material).relief;
    sprout.form = SproutForm::leaf;
    sprout.length = leafLength(t) * (0.75f + 0.5f * dice.next()) * (broad < 0.9f ? 1.35f : 1.0f);
    sprout.width = sprout.length * (broad < 0.9f ? 0.34f : 0.72f);
    sprout.bright = (0.55f + 0.80f * deep) * (0.82f + 0.36f * dice.next());
    sprouts.push_back(sprout);
  }

  const RenderScene& scene_;
  const RenderFrame& frame_;
};

/// On which of the triangle's two materials this kind of foliage grows: 1 the first, 2 the second, 3 both, 0 neither.
int grownOn(const Kind& kind, const RenderScene& scene, const RenderFrame& frame, const RenderVertex& one) {
  if (!isNear(kind, one, frame)) return 0;
  return (grows(kind, one.material, scene) ? 1 : 0) + (grows(kind, one.second, scene) ? 2 : 0);
}

}  // namespace

Foliage foliageOf(const RenderScene& scene, const RenderFrame& frame) {
  Foliage foliage;
  foliage.constants.view_projection = frame.view_projection;
  foliage.constants.eye = frame.eye;
  foliage.constants.offset = glm::vec4(glm::vec3(frame.pattern_offset), kLawn.far);
  Sower sower(scene, frame);
  // About six triangles share a vertex, so the expensive noise is computed only once for each vertex. kUnknown marks a
  // vertex for which it is not yet computed.
  constexpr float kUnknown = -2;
  std::vector<float> growth(scene.vertices.size(), kUnknown);
  for (size_t i = 0; i + 2 < scene.indices.size(); i += 3) {
    const auto corner = [&](size_t k) { return &scene.vertices[scene.indices[i + k]]; };
    const std::array<const RenderVertex*, 3> corners{corner(0), corner(1), corner(2)};
    if (const int leafy = grownOn(kLeaves, scene, frame, *corners[0]))
      sower.sow(kLeaves, leafy, corners, foliage.sprouts);
    const int grassy = grownOn(kLawn, scene, frame, *corners[0]);
    if (grassy == 0) continue;
    sower.sow(kLawn, grassy, corners, foliage.sprouts);
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t index = scene.indices[i + k];
      RenderVertex vertex = scene.vertices[index];
      if (growth[index] == kUnknown) growth[index] = growthAt(kLawn, vertex.position, frame);
      vertex.texture = {static_cast<float>(grassy), growth[index]};
      foliage.ground.push_back(vertex);
    }
  }
  return foliage;
}

bool hasLeaves(const RenderMaterial& material) { return grows(kLeaves, material); }

bool isCrown(const RenderScene& scene, const RenderFrame& frame, const std::array<const RenderVertex*, 3>& corners) {
  const RenderVertex& one = *corners[0];
  const auto isAlone = [](const RenderVertex* corner) { return corner->share == 0; };
  return grows(kLeaves, one.material, scene) && isNear(kLeaves, one, frame) &&
         (grows(kLeaves, one.second, scene) || std::ranges::all_of(corners, isAlone));
}

bool isCrownGap(const RenderFrame& frame, glm::vec3 position, float facing) {
  const float rim = 1 - glm::smoothstep(0.05f, 0.6f, facing);
  return growthAt(kLeaves, position, frame) < glm::mix(kLeastGrowth, 0.1f, rim);
}

std::vector<uint32_t> withoutCrowns(const RenderScene& scene, const RenderFrame& frame,
                                    std::span<const uint32_t> indices) {
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

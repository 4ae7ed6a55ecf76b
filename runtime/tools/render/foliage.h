#pragma once
// The blades of lawns and the leaves of crowns: where they stand on the mesh.

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "tools/render/frame.h"

namespace sgm {

/// Push constants, as shaders/render/foliage.glsl reads them.
struct FoliageConstants {
  glm::mat4 view_projection;
  glm::vec4 eye, offset;
};
static_assert(sizeof(FoliageConstants) <= 128, "no device promises more");

/// What a sprout is drawn as; shaders/render/sprout.vert has the numbers.
enum class SproutForm : uint32_t { blade, leaf, white_blossom, yellow_blossom, dry_blade };

/// A blade, a leaf or a blossom, laid out as shaders/render/sprout.vert reads it. Lengths in metres.
struct Sprout {
  glm::vec3 root{0};  ///< of a leaf: its middle
  float length = 0;
  glm::vec3 normal{0};  ///< of the surface that it grows on
  float width = 0;
  uint32_t material = 0;
  uint32_t lot = 0;  ///< drawn by chance: which way it turns
  SproutForm form = SproutForm::blade;
  float bright = 1;  ///< less than 1 deep in a crown
};
static_assert(sizeof(Sprout) == 48);

/// Corners of the strip that a sprout is drawn as.
inline constexpr uint32_t kSproutCorners = 7;

/// What grows in a picture.
struct Foliage {
  FoliageConstants constants;
  /// The ground between blades, three corners a triangle. RenderVertex::texture.x says which of its materials is a
  /// lawn: 1 the first, 2 the second, 3 both; y how tall blades grow there, 0..1.
  std::vector<RenderVertex> ground;
  std::vector<Sprout> sprouts;
};

/// Blades and leaves of what lies near enough to show them and within the picture. The farther away, the fewer and the
/// larger they are. scene must have been checked, and frame be its own. May throw std::bad_alloc.
Foliage foliageOf(const RenderScene& scene, const Frame& frame);

/// Whether leaves are drawn for a material.
bool hasLeaves(const RenderMaterial& material);

/// Whether a triangle with these corners is part of a crown: its leaves are drawn, and its own surface is not.
bool isCrown(const RenderScene& scene, const Frame& frame, const std::array<const RenderVertex*, 3>& corners);

/// Whether one sees through a crown at a place of its surface, between sprigs: by the cosine of its normal to the eye.
bool isCrownGap(const Frame& frame, glm::vec3 position, float facing);

/// Those triangles of `indices` that are drawn beside foliage: of a crown that has leaves the leaves alone are seen,
/// and between them what is behind it. scene must have been checked, and frame be its own. May throw std::bad_alloc.
std::vector<uint32_t> withoutCrowns(const RenderScene& scene, const Frame& frame, std::span<const uint32_t> indices);

}  // namespace sgm

#pragma once
// Places the blades of lawns and the leaves of crowns on the mesh.

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

/// The shape of a sprout; shaders/render/sprout.vert uses the same numbers.
enum class SproutForm : uint32_t { blade, leaf, white_blossom, yellow_blossom, dry_blade };

/// A blade, a leaf or a blossom, laid out as shaders/render/sprout.vert reads it. Lengths in metres.
struct Sprout {
  glm::vec3 root{0};  ///< of a leaf: its centre
  float length = 0;
  glm::vec3 normal{0};  ///< of the surface that it grows on
  float width = 0;
  uint32_t material = 0;
  uint32_t lot = 0;  ///< random number, which sets its rotation
  SproutForm form = SproutForm::blade;
  float bright = 1;  ///< less than 1 deep in a crown
};
static_assert(sizeof(Sprout) == 48);

/// Vertices of a sprout's triangle strip.
inline constexpr uint32_t kSproutCorners = 7;

/// The foliage of a picture.
struct Foliage {
  FoliageConstants constants;
  /// The ground between blades, as a list of triangles. RenderVertex::texture.x tells which of its materials is a lawn:
  /// 1 the first, 2 the second, 3 both; y: height of the blades there, 0..1.
  std::vector<RenderVertex> ground;
  std::vector<Sprout> sprouts;
};

/// Blades and leaves in the picture, of surfaces near enough to show them. With distance they become fewer and larger.
/// scene must be checked, and frame belong to it. May throw std::bad_alloc.
Foliage foliageOf(const RenderScene& scene, const Frame& frame);

/// Whether leaves are drawn for a material.
bool hasLeaves(const RenderMaterial& material);

/// Whether a triangle with these corners is part of a crown: its leaves are drawn, and its own surface is not.
bool isCrown(const RenderScene& scene, const Frame& frame, const std::array<const RenderVertex*, 3>& corners);

/// Whether a place on a crown's surface is a gap between sprigs; facing: cosine of its normal to the eye.
bool isCrownGap(const Frame& frame, glm::vec3 position, float facing);

/// The triangles of `indices` to draw besides foliage: crowns with leaves are omitted, since only their leaves and what
/// is behind them are visible. scene must be checked, and frame belong to it. May throw std::bad_alloc.
std::vector<uint32_t> withoutCrowns(const RenderScene& scene, const Frame& frame, std::span<const uint32_t> indices);

}  // namespace sgm

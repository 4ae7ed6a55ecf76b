#pragma once
// Places blades of grass on the lawns of a mesh, and leaves on its tree crowns.

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "tools/render/frame.h"

namespace sgm {

/// Push constants with the layout of shaders/render/foliage.glsl.
struct FoliageConstants {
  glm::mat4 view_projection;
  glm::vec4 eye, offset;
};
static_assert(sizeof(FoliageConstants) <= 128, "no device promises more");

/// The shape of a sprout. shaders/render/sprout.vert uses the same numbers.
enum class SproutForm : uint32_t { blade, leaf, white_blossom, yellow_blossom, dry_blade };

/// A blade of grass, a leaf or a blossom, in the memory layout that shaders/render/sprout.vert reads. Lengths are in
/// metres.
struct Sprout {
  glm::vec3 root{0};  ///< position of a blade's foot or of a leaf's centre
  float length = 0;
  glm::vec3 normal{0};  ///< normal of the surface on which the sprout grows
  float width = 0;
  uint32_t material = 0;
  uint32_t lot = 0;  ///< random number that sets the sprout's rotation
  SproutForm form = SproutForm::blade;
  float bright = 1;  ///< factor of the sprout's brightness; less than 1 deep in a crown
};
static_assert(sizeof(Sprout) == 48);

/// Number of vertices in a sprout's triangle strip.
inline constexpr uint32_t kSproutCorners = 7;

/// The foliage in a picture.
struct Foliage {
  FoliageConstants constants;
  /// Triangles of the ground under the grass, three vertices each. RenderVertex::texture.x tells which of the vertex's
  /// two materials is a lawn: 1 the first, 2 the second, 3 both. texture.y: height of the blades at the vertex, 0..1.
  std::vector<RenderVertex> ground;
  std::vector<Sprout> sprouts;
};

/// Makes the blades and leaves for a picture, on surfaces near enough to show them. Distant blades and leaves are fewer
/// and larger. Contract: the scene is checked, and frame belongs to it. May throw std::bad_alloc.
Foliage foliageOf(const RenderScene& scene, const RenderFrame& frame);

/// Whether leaves are drawn on surfaces of this material.
bool hasLeaves(const RenderMaterial& material);

/// Whether the triangle with these corners belongs to a tree crown: its leaves are drawn, but not the triangle itself.
bool isCrown(const RenderScene& scene, const RenderFrame& frame, const std::array<const RenderVertex*, 3>& corners);

/// Whether a point on a crown's surface is a gap between sprigs. facing: cosine between the surface normal and the
/// direction to the eye.
bool isCrownGap(const RenderFrame& frame, glm::vec3 position, float facing);

/// Returns `indices` without the triangles of tree crowns: only a crown's leaves and the things behind it are visible.
/// Contract: the scene is checked, and frame belongs to it. May throw std::bad_alloc.
std::vector<uint32_t> withoutCrowns(const RenderScene& scene, const RenderFrame& frame,
                                    std::span<const uint32_t> indices);

}  // namespace sgm

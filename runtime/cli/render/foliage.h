#pragma once
// The blades of lawns and the leaves of crowns: which triangles carry them, and in how many layers they are drawn.

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "render/frame.h"

namespace sgm {

/// Push constants, as shaders/render/foliage.glsl reads them.
struct FoliageConstants {
  glm::mat4 view_projection;
  glm::vec4 eye, offset, kind;
};
static_assert(sizeof(FoliageConstants) <= 128, "no device promises more");

/// Layers of one kind over some triangles.
struct Foliage {
  FoliageConstants constants;
  uint32_t layers = 0;
  /// Three a triangle. RenderVertex::texture.x says which of its materials are of this kind: 1 the first, 2 the second,
  /// 3 both; y how it grows there: the height of the tallest blades, 0..1, or of leaves -1..1, below 0 between sprigs.
  std::vector<RenderVertex> vertices;
};

/// Blades, and leaves, of what lies near enough to show them. scene must have been checked, and frame be its own. May
/// throw std::bad_alloc.
std::array<Foliage, 2> foliageOf(const RenderScene& scene, const Frame& frame);

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

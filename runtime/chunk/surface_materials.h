#pragma once
// Finds the materials of a world's surface at its vertices and around them.

#include <span>

#include "texture/material_blend.h"
#include "texture/texture_space.h"
#include "world/world_field.h"

namespace sgm {

/// Finds the materials at each point and at eight places around it. The places lie one cell of the level away, in the
/// plane perpendicular to the point's normal. A normal may have any length except 0. The result is a pure function of
/// the point, so adjacent chunks agree at their border. A place in the air without a material gets the material of the
/// solid behind it. The field is compiled for the bounding box of all points, so pass distant points in separate calls.
/// Errors: those of WorldField::compile.
Result<void> materialsAround(const WorldField& field, int level, const EditSnapshot* edits,
                             std::span<const Int3> points, std::span<const TexturePoint> normals,
                             std::span<MaterialMix> materials);

}  // namespace sgm

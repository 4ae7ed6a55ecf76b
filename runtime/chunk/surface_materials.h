#pragma once
// Finds the materials of a world's surface at its vertices and around them.

#include <span>

#include "texture/material_blend.h"
#include "texture/texture_space.h"
#include "world/world_field.h"

namespace sgm {

/// Finds the materials at each point and at eight places around it. These lie one cell of the level away, in the plane
/// perpendicular to the normal, which may have any length except 0. A pure function, so that adjacent chunks agree at
/// their border. The field is compiled for the bounding box of all points, so pass distant points in separate calls. A
/// place in the air without a material gets that of the solid behind it. Errors: those of WorldField::compile.
Result<void> materialsAround(const WorldField& field, int level, const EditSnapshot* edits,
                             std::span<const Int3> points, std::span<const TexturePoint> normals,
                             std::span<MaterialMix> materials);

}  // namespace sgm

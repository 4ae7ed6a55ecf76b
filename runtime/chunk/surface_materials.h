#pragma once
// The materials of a world's surface around its vertices.

#include <span>

#include "texture/material_blend.h"
#include "texture/texture_space.h"
#include "world/world_field.h"

namespace sgm {

/// Finds the materials at each point and at eight places around it, one cell of the level away in the plane
/// perpendicular to the normal, whose length may be any but 0. A pure function, so adjacent chunks agree on their
/// border. The field is compiled for the bounding box of all points, so pass distant points in separate calls. Places
/// in the air without a material take that of the solid behind them. Errors: those of WorldField::compile.
Result<void> materialsAround(const WorldField& field, int level, const EditSnapshot* edits,
                             std::span<const Int3> points, std::span<const TexturePoint> normals,
                             std::span<MaterialMix> materials);

}  // namespace sgm

#pragma once
// What a world's surface is made of around its vertices.

#include <span>

#include "texture/material_blend.h"
#include "texture/texture_space.h"
#include "world/world_field.h"

namespace sgm {

/// The materials at each point and at eight places around it, a cell of the level away on the plane that the normal
/// (any length but 0) stands on: pure, so that chunks that meet agree on their border. Points far from each other are
/// better asked about apart: all that lies between is compiled. Places in the air without a material take
/// that of the solid behind them. Errors: those of WorldField::compile.
Result<void> materialsAround(const WorldField& field, int level, const EditSnapshot* edits,
                             std::span<const Int3> points, std::span<const TexturePoint> normals,
                             std::span<MaterialMix> materials);

}  // namespace sgm

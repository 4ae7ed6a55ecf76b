#pragma once
// The appearance of materials for which a game has set no material, from the table that the command sgm also uses
// (runtime/tools/materials).

#include <string_view>

#include "godot/variant.h"
#include "tools/materials/material.h"

namespace sgm_godot {

/// The colour for a material's name in the grammar (sRGB, as in the inspector; alpha: roughness).
Color colorOf(std::string_view material);

/// The colour converted to linear RGB, as shaders need it; alpha (the roughness) is unchanged.
Color linear(Color srgb);

}  // namespace sgm_godot

#pragma once
// How materials look that a game has given no material of its own: as in the table that the sgm command draws from
// (runtime/tools/materials).

#include <string_view>

#include "godot/variant.h"
#include "tools/materials/material.h"

namespace sgm_godot {

/// The colour of what the grammar calls the material (sRGB, as in the inspector; alpha: roughness).
Color colorOf(std::string_view material);

/// As shaders take it; the roughness stays.
Color linear(Color srgb);

}  // namespace sgm_godot

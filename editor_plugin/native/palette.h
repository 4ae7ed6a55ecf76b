#pragma once
// How materials look that a game has given no material of its own.

#include <string_view>

#include "godot/variant.h"

namespace sgm_godot {

/// A colour (sRGB; alpha: roughness) by what the grammar calls the material: a word that is known in its name
/// ("wet_limestone"), else one that the name alone decides.
Color colorOf(std::string_view material);

}  // namespace sgm_godot

#pragma once
// What the parts of scopes and the proof of where they lie agree upon.

#include "base/fixed.h"

namespace sgm {

/// Metres by which a part reaches beyond where it meets the next one of its split. Solids that share a face alone would
/// leave a sheet of void where samples lie in that face: this is more than the rounding of their places and than the
/// step in which cells of up to 2 m are sampled.
inline constexpr double kSeamOverlap = 2.0 / kUnitsPerMetre;

}  // namespace sgm

#pragma once
// The valid ranges for the measures of footprints and roofs. The checker tests constants; derivation tests other
// values.

#include "base/math.h"
#include "grammar/syntax/builtins.h"

namespace sgm {

inline constexpr double kLeastPitch = kPi / 36, kMaxPitch = kPi / 9 * 4;  ///< 5 and 80 degrees

inline constexpr ValueRange kMergeRange{1, 64, "a footprint merges 1 to 64 pieces", "such as merge 3"};
inline constexpr ValueRange kCornerRange{3, 64, "a regular polygon has 3 to 64 corners", "such as regular(6, 8m)"};
inline constexpr ValueRange kPitchRange{kLeastPitch * (1 - 1e-12), kMaxPitch*(1 + 1e-12),
                                        "the pitch of a roof is 5deg to 80deg", "such as 35deg"};
inline constexpr ValueRange kOverhangRange{0, 1e5, "the overhang of a roof is 0m or more", "such as overhang 0.5m"};

/// The maximum distance by which a corner of a roof moves outwards, as a multiple of the overhang. Limits the miter of
/// corners sharper than 60 degrees.
inline constexpr double kMaxMiter = 2;

}  // namespace sgm

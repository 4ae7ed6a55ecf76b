#pragma once
// Constants of statements that divide scopes into parts, used by the checker, derivation and the proof of reach.

#include "base/fixed.h"
#include "grammar/syntax/builtins.h"

namespace sgm {

/// Metres by which a part of a split extends beyond its border with the next part. Solids that only share a face would
/// leave a thin sheet of void where samples lie exactly in that face. The overlap exceeds the rounding of positions,
/// and the sampling step of cells of up to 2 m.
inline constexpr double kSeamOverlap = 2.0 / kUnitsPerMetre;

inline constexpr ValueRange kSnapRange{0.01, 1e5, "snap planes are 1cm or more apart", "such as snap y 3.2m"};

inline constexpr ValueRange kSnapReachRange{0, 1e5, "the snap reach of a split is 0m or more", "such as snap 0.5m"};

/// Metres by which the entrance of a treemap extends outwards beyond its floor, and by which doors extend into the
/// spaces that they join.
inline constexpr double kDoorReach = 16.0 / kUnitsPerMetre;

inline constexpr size_t kMaxRooms = 32;
inline constexpr ValueRange kRoomAreaRange{1e-6, 1e6, "the area of a room is a millionth to a million",
                                           "such as `living 28`"};
inline constexpr ValueRange kWallRange{0.01, 5, "the walls of a treemap are 1cm to 5m thick", "such as wall 0.2m"};
inline constexpr ValueRange kDoorRange{0.1, 100, "a door is 0.1m to 100m wide", "such as door 0.9m"};
inline constexpr ValueRange kDoorHeightRange{0.1, 100, "a door is 0.1m to 100m high", "such as height 2.1m"};
inline constexpr ValueRange kCorridorRange{0.1, 100, "a corridor is 0.1m to 100m wide", "such as corridor 1.2m"};

inline constexpr size_t kMaxTiles = 64;
inline constexpr size_t kMaxLabels = 63;
inline constexpr size_t kMaxSideKinds = 64;
inline constexpr double kMaxPlaces = 32768;
inline constexpr ValueRange kTileRange{0.01, 1e5, "a tile is 1cm or more along each axis", "such as wfc 2m"};
inline constexpr ValueRange kTileWeightRange{0, 1e6, "the weight of a tile is 0 to a million", "such as `wall 3`"};

}  // namespace sgm

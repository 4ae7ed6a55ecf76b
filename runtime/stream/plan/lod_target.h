#pragma once
// The octree that the viewers want: chunks small enough that no cell looks larger than requested.

#include <array>
#include <span>

#include "stream/plan/octree.h"

namespace sgm {

/// A place around which detail is wanted. Position in units, with fractions; all values are finite.
struct LodViewer {
  std::array<double, 3> position{};
  double reach = 1;  ///< factor on all distances below, above 0: more for a viewer with more weight
  friend bool operator==(const LodViewer&, const LodViewer&) = default;
};

struct LodSettings {
  int top = 8;  ///< coarsest level, 0..kMaxLevel
  int32_t finest_cell = kUnitsPerMetre / 2;
  /// Distance in units from a viewer within which level 0 is wanted; each coarser level reaches twice as far. For a
  /// screen of h pixels, a vertical field of view v and cells of at most p pixels, use 2 * finest_cell * h / (2 tan(v /
  /// 2)) / p.
  double finest_distance = 24.0 * kUnitsPerMetre;
  /// Everything up to this distance, in units, is drawn. Work grows with the cube of its ratio to the edge of a virtual
  /// node; a coarser top keeps the ratio small.
  double view_distance = 1000.0 * kUnitsPerMetre;
};

/// Returns the octree for these viewers, closed under the rules; empty without viewers. A pure function. At the world's
/// ends, space where a virtual node would stick out is not drawn. finest: the level-1 nodes that may be split because
/// of viewers; null: all.
Octree lodTarget(std::span<const LodViewer> viewers, const LodSettings& settings, const ChunkSet* finest = nullptr);

/// The coarsest such octree with level 0 within `distance` (units above 0, times a viewer's reach): the chunks needed
/// to stand there. Never finer than lodTarget() with a finest_distance and view_distance at least as large.
Octree nearTarget(std::span<const LodViewer> viewers, const LodSettings& settings, double distance,
                  const ChunkSet* finest = nullptr);

/// The largest number of planned chunks; each costs about a microsecond per plan, and half a kilobyte.
inline constexpr double kMostExpectedLeaves = 131072;

/// Estimates the number of chunks of lodTarget(), rather too high. Fast.
double expectedLeaves(std::span<const LodViewer> viewers, const LodSettings& settings);

/// The distance in units from a place to a chunk's closed box; 0 inside.
double distanceToChunk(const std::array<double, 3>& place, const ChunkKey& key, int32_t finest_cell);

}  // namespace sgm

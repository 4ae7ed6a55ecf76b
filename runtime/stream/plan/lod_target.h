#pragma once
// Which octree the viewers want: chunks so small that no cell looks larger than asked for.

#include <array>
#include <span>

#include "stream/plan/octree.h"

namespace sgm {

/// A place that detail is wanted around. Positions in units, also between them; everything finite.
struct LodViewer {
  std::array<double, 3> position{};
  double reach = 1;  ///< factor on all distances below: a viewer of more weight sees detail farther away; above 0
  friend bool operator==(const LodViewer&, const LodViewer&) = default;
};

struct LodSettings {
  int top = 8;  ///< coarsest level, 0..kMaxLevel
  int32_t finest_cell = kUnitsPerMetre / 2;
  /// Distance in units from a viewer within which level 0 is wanted; each coarser level reaches twice as far. With a
  /// screen of h pixels and a vertical field of view v, cells of at most p pixels ask for
  /// 2 * finest_cell * h / (2 tan(v / 2)) / p.
  double finest_distance = 24.0 * kUnitsPerMetre;
  /// Something is drawn at least this far, in units. Work grows with the cube of its ratio to a virtual node's edge,
  /// which a coarser top keeps small.
  double view_distance = 1000.0 * kUnitsPerMetre;
};

/// The octree for these viewers, closed under the rules. A pure function; no viewers: an empty tree. At the world's
/// ends nothing is drawn where a virtual node would stick out. finest: the level-1 nodes that may be split for a
/// viewer's sake; null: all.
Octree lodTarget(std::span<const LodViewer> viewers, const LodSettings& settings, const ChunkSet* finest = nullptr);

/// The coarsest such octree that has level 0 within `distance` (units above 0, times a viewer's reach): what it takes
/// to stand there. Never finer than lodTarget() with a finest_distance and a view_distance that are no smaller.
Octree nearTarget(std::span<const LodViewer> viewers, const LodSettings& settings, double distance,
                  const ChunkSet* finest = nullptr);

/// The most chunks that are planned for; each costs about a microsecond a plan, and half a kilobyte.
inline constexpr double kMostExpectedLeaves = 131072;

/// About how many chunks lodTarget() gives, more rather than less: found in no time.
double expectedLeaves(std::span<const LodViewer> viewers, const LodSettings& settings);

/// Distance in units from a place to a chunk's closed box; 0 inside.
double distanceToChunk(const std::array<double, 3>& place, const ChunkKey& key, int32_t finest_cell);

}  // namespace sgm

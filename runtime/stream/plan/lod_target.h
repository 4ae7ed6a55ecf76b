#pragma once
// Computes the octree that the viewers need: chunks small enough that no cell looks larger than requested.

#include <array>
#include <span>

#include "stream/plan/octree.h"

namespace sgm {

/// A position around which detail is needed. In units, with fractions; all values are finite.
struct LodViewer {
  std::array<double, 3> position{};
  double reach = 1;  ///< factor on all distances in LodSettings, above 0: larger for a viewer with more weight
  friend bool operator==(const LodViewer&, const LodViewer&) = default;
};

struct LodSettings {
  int top = 8;  ///< level of the coarsest chunks, 0..kMaxLevel
  int32_t finest_cell = kUnitsPerMetre / 2;
  /// Distance from a viewer, in units, within which level 0 is drawn; each coarser level is drawn up to twice that
  /// distance. For a screen of h pixels, a vertical field of view v and cells of at most p pixels, use 2 * finest_cell
  /// * h / (2 tan(v / 2)) / p.
  double finest_distance = 24.0 * kUnitsPerMetre;
  /// Everything up to this distance, in units, is drawn. The work grows with the cube of its ratio to the edge of a
  /// virtual node (octree.h); a coarser top level makes that ratio smaller.
  double view_distance = 1000.0 * kUnitsPerMetre;
};

/// Returns the octree for these viewers, which satisfies the octree's rules; empty without viewers. A pure function. At
/// the ends of the world, where a virtual node would extend beyond the world, nothing is drawn. finest: the level-1
/// nodes that viewers may split; null: all nodes.
Octree lodTarget(std::span<const LodViewer> viewers, const LodSettings& settings, const ChunkSet* finest = nullptr);

/// Returns the coarsest such octree that has level 0 within `distance` of each viewer (in units, above 0, times the
/// viewer's reach): the chunks needed to stand there. Never finer than lodTarget() with a finest_distance and a
/// view_distance at least as large.
Octree nearTarget(std::span<const LodViewer> viewers, const LodSettings& settings, double distance,
                  const ChunkSet* finest = nullptr);

/// The maximum number of chunks in a plan; each costs about a microsecond per plan, and half a kilobyte.
inline constexpr double kMaxExpectedLeaves = 131072;

/// Estimates the number of chunks of lodTarget(); the estimate tends to be too high. Fast.
double expectedLeaves(std::span<const LodViewer> viewers, const LodSettings& settings);

/// Returns the distance in units from a position to a chunk's closed box; 0 inside.
double distanceToChunk(const std::array<double, 3>& place, const ChunkKey& key, int32_t finest_cell);

}  // namespace sgm

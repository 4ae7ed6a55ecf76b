#pragma once
// Computes the octree that the viewers need: its chunks are so small that no cell looks larger than requested.

#include <array>
#include <span>

#include "stream/plan/octree.h"

namespace sgm {

/// A position around which detail is needed, in units (possibly fractional). All values are finite.
struct LodViewer {
  std::array<double, 3> position{};
  double reach = 1;  ///< factor, above 0, by which all distances of LodSettings are multiplied for this viewer; larger
                     ///< for a more important viewer
  friend bool operator==(const LodViewer&, const LodViewer&) = default;
};

struct LodSettings {
  int top = 8;  ///< level of the coarsest chunks, 0..kMaxLevel
  int32_t finest_cell = kUnitsPerMetre / 2;
  /// Distance from a viewer, in units, within which level 0 is drawn; each coarser level is drawn up to twice the
  /// distance of the previous one. On a screen of h pixels with vertical field of view v, cells look at most p pixels
  /// large if this distance is 2 * finest_cell * h / (2 tan(v / 2)) / p.
  double finest_distance = 24.0 * kUnitsPerMetre;
  /// Distance from a viewer, in units, within which everything is drawn. The number of chunks grows with the cube of
  /// this distance, divided by the edge of the octree's root nodes (virtual nodes, octree.h); a coarser top level makes
  /// the root nodes larger.
  double view_distance = 1000.0 * kUnitsPerMetre;
};

/// Returns the octree for these viewers, which satisfies the octree's rules; empty without viewers. A pure function.
/// Virtual nodes that would extend beyond the world are not drawn. finest: the level-1 nodes that may be split (into
/// level-0 chunks); null: all of them.
Octree lodTarget(std::span<const LodViewer> viewers, const LodSettings& settings, const ChunkSet* finest = nullptr);

/// Returns the coarsest octree (as by lodTarget()) that has level-0 chunks (on which a viewer can stand) within
/// `distance` of each viewer. distance: in units, above 0; it is multiplied by the viewer's reach. The result is never
/// finer than lodTarget() with a finest_distance and a view_distance at least as large.
Octree nearTarget(std::span<const LodViewer> viewers, const LodSettings& settings, double distance,
                  const ChunkSet* finest = nullptr);

/// The maximum number of chunks in a plan. Each chunk costs about a microsecond per plan, and half a kilobyte of
/// memory.
inline constexpr double kMaxExpectedLeaves = 131072;

/// Estimates how many chunks lodTarget() draws, quickly; the estimate tends to be too high.
double expectedLeaves(std::span<const LodViewer> viewers, const LodSettings& settings);

/// Returns the distance in units from a position to a chunk's box; 0 inside.
double distanceToChunk(const std::array<double, 3>& place, const ChunkKey& key, int32_t finest_cell);

}  // namespace sgm

#pragma once
// The voids of a region for an agent of a size, and the way through them from one place to another.
//
// What counts is the samples of level 0, a cell apart. The agent is a ball. A sample is free for it where no solid
// sample, those beyond the region's border included, is as near as its radius or nearer (mesh/clearance.h); with radius
// 0 all of the void is free. Free samples join along the axes and across the diagonals of faces, as the mesh joins its
// voids (region/components.h), and a way goes from sample to joined sample, within the region. So a way stands for
// the ball to within cells: between two of its samples the nearest solid sample may be nearer by 0.71 cells, and the
// surface lies before that by less than 1.74 cells, as a rule less than one.
//
// A place stands for the nearest of the eight samples around it that are void; with none it lies in rock.

#include <optional>
#include <vector>

#include "chunk/mesh_chunks.h"
#include "query/sign_window.h"
#include "query/void_graph.h"

namespace sgm {

struct VoidQuestion {
  IntBox region;      ///< lo <= p < hi, units; grown to whole chunks
  double radius = 0;  ///< of the agent, units: 0 to less than kMostClearance cells
  struct Ends {
    std::array<double, 3> from{}, to{};  ///< units, in the region
    bool widest = false;                 ///< also find how large an agent may be
    bool tell_metres = false;            ///< errors tell places in metres, not in units
  };
  std::optional<Ends> ends;     ///< none: no way is asked for
  uint64_t max_chunks = 65536;  ///< of the region; never more than 2^24
};

enum class WayVerdict {
  found,
  from_in_rock,
  to_in_rock,
  from_too_narrow,  ///< a place is in the void, but the agent does not fit there
  to_too_narrow,
  apart,  ///< the agent fits at both places, and there is no way between them
};

/// A way from one place to another, or why there is none. Lengths in units.
struct VoidWay {
  WayVerdict verdict = WayVerdict::apart;
  /// Samples from that of `from` to that of `to`, each joined with the one before: the shortest such way within the
  /// chunks that VoidGraph::chunksOfWay() chooses. Empty where there is none.
  std::vector<Int3> places;
  double length = 0;
  /// From each place's sample to the nearest solid one, at most kMostClearance cells; 0 in rock. Rounded up, so that an
  /// agent of this radius does not fit there.
  double from_clearance = 0, to_clearance = 0;
  /// Where it was asked for: there is a way for every radius below this, and for none from it on; 0: for no agent at
  /// all. Exact, up to kMostClearance cells, from which on it stands for any larger value too: asked with this radius
  /// there is no way, with the next number below there is one.
  double widest = 0;
  /// Samples of the voids that the two places lie in, for this radius; 0 where one is not free.
  uint64_t from_samples = 0, to_samples = 0;
};

struct VoidAnswer {
  IntBox extent;  ///< the region grown to whole chunks; hi does not belong to it, but samples on it do
  uint64_t chunks = 0;
  double sample = 0;              ///< m3 that one sample stands for
  std::vector<RegionVoid> voids;  ///< the largest ones first
  std::optional<VoidWay> way;     ///< where ends are given
};

/// Looks at the region's chunks one after the other, across its longest axis, and keeps their voids and what these
/// share; of samples the signs (a bit each, 8.7 KB a chunk that is not all solid or all void) of about two layers of
/// chunks with one around them, and the faces of one (void_graph.h). A way takes 12 bytes a place, and up to 300 a
/// chunk (void_walk.h). To find the widest agent it looks again, at most twice. The same answer whatever the job system
/// does. progress: counts chunks, of each look by itself, and of the walk that finds the way.
/// Errors: invalid_argument (the region is empty; the radius; an end outside of the region, or not finite), range (the
/// region, with one chunk around it, leaves the world), limit (more than max_chunks chunks, or 2^32 voids), cancelled,
/// and those of compiling the field.
Result<VoidAnswer> findVoids(const SignField& field, JobSystem& jobs, const VoidQuestion& question,
                             const Progress& progress = {});

}  // namespace sgm

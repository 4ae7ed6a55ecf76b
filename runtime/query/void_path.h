#pragma once
// Finds the voids of a region for an agent of one size, and a path through them from one place to another.
//
// Works on the samples of level 0, one cell apart. The agent is a ball. A sample is free if no solid sample, inside or
// outside of the region, is within the agent's radius (mesh/clearance.h); with radius 0 every void sample is free. Free
// samples connect along the axes and across the diagonals of faces, as the mesh connects its voids
// (region/components.h). A path goes from sample to connected sample within the region.
//
// A path is valid for the ball only approximately, for two reasons. Between two samples of the path, the nearest solid
// sample may be up to 0.71 cells nearer than at the samples. And the surface lies less than 1.74 cells, usually less
// than one, in front of that solid sample.
//
// A place is represented by the nearest void sample of the eight around it; if all eight are solid, the place lies in
// rock.

#include <optional>
#include <vector>

#include "chunk/mesh_chunks.h"
#include "query/sign_window.h"
#include "query/void_graph.h"

namespace sgm {

struct VoidQuestion {
  IntBox region;      ///< the searched box lo <= p < hi, units; it is enlarged to whole chunks
  double radius = 0;  ///< radius of the agent in units: 0 to less than kMaxClearance cells
  struct Ends {
    std::array<double, 3> from{}, to{};  ///< positions of the ends of the path, in units; they must lie in the region
    bool widest = false;                 ///< true: also find the largest agent for which a path exists
    bool tell_metres = false;            ///< true: error messages give places in metres; false: in units
  };
  std::optional<Ends> ends;     ///< ends of the requested path; nullopt: no path is requested
  uint64_t max_chunks = 65536;  ///< maximum number of chunks of the region; values above 2^24 count as 2^24
};

enum class WayVerdict {
  found,
  from_in_rock,
  to_in_rock,
  from_too_narrow,  ///< the place is in the void, but the agent does not fit there
  to_too_narrow,
  apart,  ///< the agent fits at both places, but no path connects them
};

/// A path from one place to another, or the reason why there is none. Lengths in units.
struct VoidWay {
  WayVerdict verdict = WayVerdict::apart;
  /// The samples of the path, from the sample of `from` to the sample of `to`, each connected with the previous one. It
  /// is the shortest path within the chunks that VoidGraph::chunksOfWay() chooses. Empty if there is no path.
  std::vector<Int3> places;
  double length = 0;
  /// The distance from the sample of each end to the nearest solid sample, in units, at most kMaxClearance cells; 0 in
  /// rock. Rounded up: an agent with this radius does not fit there.
  double from_clearance = 0, to_clearance = 0;
  /// Filled in if requested: the smallest radius, in units, for which there is no path; a path exists for every smaller
  /// radius. 0: there is no path for any radius. Exact: the next smaller floating-point number has a path. The value
  /// kMaxClearance cells also stands for all larger values.
  double widest = 0;
  /// For each end of the path: the number of samples in the void that contains the end, for an agent of the requested
  /// radius; 0 if the agent does not fit there.
  uint64_t from_samples = 0, to_samples = 0;
};

struct VoidAnswer {
  /// the region enlarged to whole chunks; hi is excluded, but the samples on the high faces are included
  IntBox extent;
  uint64_t chunks = 0;
  double sample = 0;              ///< volume of one sample in m3
  std::vector<RegionVoid> voids;  ///< connected voids, largest first
  std::optional<VoidWay> way;     ///< result for the path, if ends are given
};

/// Processes the region's chunks in order along its longest axis, and stores their voids and connections. Of the
/// samples, it keeps the signs of about two layers of chunks with one layer around them (one bit per sample: 8.7 KB for
/// a chunk that is neither all solid nor all void), and the faces of one layer (void_graph.h). A path takes 12 bytes
/// per place, and up to 300 bytes per chunk (void_walk.h). Finding the largest agent takes at most two more passes. The
/// result does not depend on the job system. progress: counts the chunks of each pass separately, and then those of the
/// search for the shortest path. Errors: invalid_argument (the region is empty; the radius; an end is outside of the
/// region, or not finite), range (the region, with one chunk around it, leaves the world), limit (more than max_chunks
/// chunks, or 2^32 voids), cancelled, and those of compiling the field.
Result<VoidAnswer> findVoids(const SignField& field, JobSystem& jobs, const VoidQuestion& question,
                             const Progress& progress = {});

}  // namespace sgm

#include "grammar/range/automaton_arguments.h"

#include <algorithm>
#include <cmath>

#include "base/fixed.h"
#include "grammar/text/sink.h"

namespace sgm {

namespace {

using Limits = AutomatonLimits;

/// Whether no value of v lies in least..most. Also true if an end of v is NaN.
bool liesOutside(Interval v, double least, double most) { return !(v.lo <= most && v.hi >= least); }

std::string fromTo(int32_t least, int32_t most) {
  return join({"from ", std::to_string(least), " to ", std::to_string(most)});
}

}  // namespace

std::optional<AutomatonFault> faultOf(const AutomatonArguments& a, int32_t cell) {
  const int32_t least = std::max(Limits::least_edge, (cell + Limits::max_voxels - 1) / Limits::max_voxels);
  // The tolerance is half a unit, since a voxel's edge is rounded to units.
  if (liesOutside(a.voxel, metres(least) - metres(1) / 2, metres(cell) + metres(1) / 2)) {
    const bool any = least <= cell;
    return AutomatonFault{
        0, join({"a cell of the layer is from 1 to ", std::to_string(Limits::max_voxels), " voxels of `ca` wide"}),
        any ? join({"here a voxel has from ", metresText(metres(least)), " to ", metresText(metres(cell))})
            : "make the layer's cells larger"};
  }
  if (liesOutside(a.fill, 0, 1)) return AutomatonFault{1, "the fill of `ca` is from 0% to 100%", "such as fill 45%"};
  if (liesOutside(a.rounds, 0, Limits::max_rounds)) {
    return AutomatonFault{2, join({"`ca` has ", fromTo(0, Limits::max_rounds), " rounds"}), "such as rounds 4"};
  }
  if (liesOutside(a.threshold, 0, 1)) {
    return AutomatonFault{3, "the threshold of `ca` is from 0% to 100%", "such as threshold 50%"};
  }
  if (liesOutside(a.radius, 1, Limits::max_radius)) {
    return AutomatonFault{4, join({"the radius of `ca` is a number, ", fromTo(1, Limits::max_radius), " voxels"}),
                          "such as radius 1"};
  }
  if (a.rounds.lo * a.radius.lo > Limits::max_halo) {
    return AutomatonFault{2, join({"rounds times radius of `ca` is at most ", std::to_string(Limits::max_halo)}),
                          "so many voxels around each cell are computed with it"};
  }
  return std::nullopt;
}

}  // namespace sgm

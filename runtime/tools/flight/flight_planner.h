#pragma once
// Plans endless flight paths through the void of a field: in caves, through passages to unvisited places; in an open
// world, on a wide spiral between the solids. Uses only the public interface.

#include <cstdint>
#include <memory>
#include <unordered_set>

#include "tools/flight/flight_curve.h"
#include "tools/flight/void_grid.h"

namespace sgm::cli {

struct AutoFlight {
  uint64_t seed = 0;  ///< seed of the random choices; the same seed gives the same path
  /// Clearance in metres that the path needs on both sides along each axis. Where no such path exists, a quarter of the
  /// clearance suffices. 0: chosen by the kind of world: 0.5 in rock, 0.5 to 4 in an open world, and half of that if
  /// the void is too narrow.
  double room = 0;
  Metres3 near_place{0};  ///< the flight begins near this position, if there is enough void
};

/// Plans a flight path piece by piece. Not thread-safe. Slow: a fraction of a second for about ten metres of passage.
class FlightPlanner {
 public:
  /// Begins a path. The field must outlive the planner. Errors: limit if there is not enough void around the beginning;
  /// those of the field.
  static Result<FlightPlanner> begin(sgm_field* field, const sgm_grammar* grammar, const AutoFlight& settings);

  /// Distance in metres at which the path should be resampled. The points of a piece, at which the clearance is
  /// checked, are at most about half of this distance apart.
  double spacing() const;
  /// Plans the next piece of the path: points from the end of the previous piece, or from the beginning. Error: limit
  /// if no path continues.
  Result<std::vector<Metres3>> next();

  /// Continues the path from a far place that depends only on the seed and the number. The place is 500 m to 5 km from
  /// the beginning, near an anchor if there is one; in a finite world, it is a random place. Error: limit if no place
  /// with enough void is found.
  Result<void> teleport(uint64_t number);

 private:
  FlightPlanner(sgm_field* field, const sgm_grammar* grammar, const AutoFlight& settings);

  /// Begins a new path near a place. Anchors up to `reach` units away are considered as starting points.
  Result<void> settle(Int3 near, int32_t reach);
  std::vector<Int3> anchorsNear(Int3 place, int32_t reach);
  Result<std::vector<Int3>> voidsNear(Int3 near, int32_t half);
  Result<void> findSolids(Int3 near);
  bool leadsOn(Int3 node);
  Result<std::vector<Int3>> wayOn();
  Result<std::vector<Int3>> wayToNew();
  Result<std::vector<Int3>> wayAround();
  Int3 waypoint(int64_t number) const;
  /// The first place on the path that has solid within `room` units along an axis; nullopt if there is none.
  Result<std::optional<Int3>> tightPlace(const std::vector<Metres3>& points, int32_t room);
  Int3 regionOf(Int3 node) const;

  sgm_field* field_;
  const sgm_grammar* grammar_;
  AutoFlight settings_;
  sgm_domain_info domain_ = SGM_DOMAIN_INFO_INIT;
  double scale_ = 0;  ///< distance between successive turns of the spiral in an open world, in units
  std::unique_ptr<VoidGrid> grid_;
  Int3 home_;  ///< node at which the flight began
  Int3 node_;  ///< node at which the planned path currently ends
  /// Direction in which the path reached node_; nullopt if it may continue in any direction.
  std::optional<Metres3> way_;
  std::unordered_set<Int3, PlaceHash> been_;
  uint64_t pieces_ = 0;
  Int3 centre_;        ///< centre of the spiral in an open world, in units
  double height_ = 0;  ///< amplitude of the vertical motion along the spiral, in units
  int64_t waypoint_ = 0;
};

}  // namespace sgm::cli

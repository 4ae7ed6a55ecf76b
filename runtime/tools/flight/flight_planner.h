#pragma once
// Plans flights through the void of a field that go on for ever: through a cave's passages to where it has not been,
// or on a wide spiral between the solids of an open world. Sees no more than the public interface.

#include <cstdint>
#include <memory>
#include <unordered_set>

#include "tools/flight/flight_curve.h"
#include "tools/flight/void_grid.h"

namespace sgm::cli {

struct AutoFlight {
  uint64_t seed = 0;  ///< of the choices on the way; the same seed makes the same flight
  /// Metres of void on every side of the path along the axes, a quarter of that where there is no other way on; 0: by
  /// the world, 0.5 in caves and half of it in narrow ones.
  double room = 0;
  Metres3 near_place{0};  ///< the flight begins near here, where there is a place for it
};

/// One thread at a time. Takes its time: a fraction of a second for some ten metres of passage.
class FlightPlanner {
 public:
  /// The field must outlive the planner. Errors: limit, no room to fly is found near the beginning; the field's own.
  static Result<FlightPlanner> begin(sgm_field* field, const sgm_grammar* grammar, const AutoFlight& settings);

  /// Distance between the points of a piece, and between the places that are known to have room.
  double spacing() const;
  /// The next piece of the flight: points from where the last one ended, or from the beginning. limit: there is no way
  /// on.
  Result<std::vector<Metres3>> next();

  /// Goes on from a far place, a function of seed and number alone: 500 m to 5 km from the beginning, near an anchor
  /// where there is one; somewhere else in it in a finite world. limit: none is found that has room.
  Result<void> teleport(uint64_t number);

 private:
  FlightPlanner(sgm_field* field, const sgm_grammar* grammar, const AutoFlight& settings);

  /// Begins near a place; anchors count up to `reach` units away.
  Result<void> settle(Int3 near, int32_t reach);
  std::vector<Int3> anchorsNear(Int3 place, int32_t reach);
  Result<std::vector<Int3>> voidsNear(Int3 near, int32_t half);
  Result<void> findSolids(Int3 near);
  bool leadsOn(Int3 node);
  Result<std::vector<Int3>> wayOn();
  Result<std::vector<Int3>> wayToNew();
  Result<std::vector<Int3>> wayAround();
  Int3 waypoint(int64_t number) const;
  /// The first place of the points that has less room, in units.
  Result<std::optional<Int3>> tightPlace(const std::vector<Metres3>& points, int32_t room);
  Int3 regionOf(Int3 node) const;

  sgm_field* field_;
  const sgm_grammar* grammar_;
  AutoFlight settings_;
  sgm_domain_info domain_ = SGM_DOMAIN_INFO_INIT;
  double scale_ = 0;  ///< of an open world: units between the turns of the spiral
  std::unique_ptr<VoidGrid> grid_;
  Int3 home_;                   ///< where the flight began
  Int3 node_;                   ///< where it has come to
  std::optional<Metres3> way_;  ///< and in which direction
  std::unordered_set<Int3, PlaceHash> been_;
  uint64_t pieces_ = 0;
  Int3 centre_;        ///< of the spiral
  double height_ = 0;  ///< units that it rises and falls
  int64_t waypoint_ = 0;
};

}  // namespace sgm::cli

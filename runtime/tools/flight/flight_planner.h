#pragma once
// Plans endless flights through the void of a field: through a cave's passages to unvisited places, or on a wide spiral
// between the solids of an open world. Uses only the public interface.

#include <cstdint>
#include <memory>
#include <unordered_set>

#include "tools/flight/flight_curve.h"
#include "tools/flight/void_grid.h"

namespace sgm::cli {

struct AutoFlight {
  uint64_t seed = 0;  ///< of the choices; the same seed makes the same flight
  /// Metres of void on every side of the path along the axes, or a quarter of that if no other path exists; 0: chosen
  /// by the world, 0.5 in caves and half of it in narrow ones.
  double room = 0;
  Metres3 near_place{0};  ///< the flight begins near here, if there is room
};

/// One thread at a time. Slow: a fraction of a second for some ten metres of passage.
class FlightPlanner {
 public:
  /// The field must outlive the planner. Errors: limit if there is no room to fly near the beginning; those of the
  /// field.
  static Result<FlightPlanner> begin(sgm_field* field, const sgm_grammar* grammar, const AutoFlight& settings);

  /// Distance between the points of a piece, and between the places that are checked for room.
  double spacing() const;
  /// The next piece of the flight: points from the end of the last piece, or from the beginning. Error: limit if there
  /// is no path on.
  Result<std::vector<Metres3>> next();

  /// Continues from a far place, which depends only on seed and number: 500 m to 5 km from the beginning, near an
  /// anchor if there is one; in a finite world, somewhere else in it. Error: limit if no place with room is found.
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
  /// The first place of the points with less room, in units; nullopt if there is none.
  Result<std::optional<Int3>> tightPlace(const std::vector<Metres3>& points, int32_t room);
  Int3 regionOf(Int3 node) const;

  sgm_field* field_;
  const sgm_grammar* grammar_;
  AutoFlight settings_;
  sgm_domain_info domain_ = SGM_DOMAIN_INFO_INIT;
  double scale_ = 0;  ///< of an open world: units between the turns of the spiral
  std::unique_ptr<VoidGrid> grid_;
  Int3 home_;                   ///< where the flight began
  Int3 node_;                   ///< the current place
  std::optional<Metres3> way_;  ///< and the direction there; nullopt: any
  std::unordered_set<Int3, PlaceHash> been_;
  uint64_t pieces_ = 0;
  Int3 centre_;        ///< of the spiral
  double height_ = 0;  ///< amplitude of its rise and fall, units
  int64_t waypoint_ = 0;
};

}  // namespace sgm::cli

#pragma once
// A polyhedron in another size with its angles kept: every face keeps its normal and moves along it, so that edges keep
// their directions and change their lengths alone (after Cabral, Lefebvre, Dachsbacher and Drettakis,
// "Structure-Preserving Reshape for Textured Architectural Scenes", EG 2009, who move vertices with edges' directions
// kept; to move faces has a third of the unknowns, and normals stay to the bit).

#include <array>
#include <optional>
#include <vector>

#include "asset/polyhedron.h"

namespace sgm::asset {

/// Where places along an axis are wanted to go: straight between its knots.
struct AxisMap {
  struct Knot {
    double from = 0, to = 0;
  };
  std::vector<Knot> knots;  ///< at least two, `from` ascending
  /// Of each stretch between knots: what lies in it goes exactly there. Else only both ends of the axis do.
  std::vector<bool> stiff;

  double operator()(double at) const;
  bool isStiff(double at, double tolerance) const;
  /// Whether what was at `from` and is at `to` has not left the stretch between knots that it was in.
  bool keeps(double from, double to, double tolerance) const;
  /// Whether it turns nothing round, or to nearly nothing.
  bool rises() const;
};

/// The polyhedron, whose box begins at the origin, as near to the maps as its angles allow: of the squared differences
/// of its edges' lengths to those that the maps give, each by the edge's own length, the sum is the least. Nothing
/// where that is impossible: demands contradict each other, an edge would be shorter than a hundredth of what it was,
/// or a corner would leave its stretch between knots.
std::optional<Polyhedron> fitConstrained(const Polyhedron& solid, const std::array<AxisMap, 3>& maps);

}  // namespace sgm::asset

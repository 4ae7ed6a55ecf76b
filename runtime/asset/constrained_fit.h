#pragma once
// Resizes a polyhedron and keeps its angles: every face keeps its normal and moves along it, so that edges keep their
// directions and change only their lengths (after Cabral, Lefebvre, Dachsbacher and Drettakis, "Structure-Preserving
// Reshape for Textured Architectural Scenes", EG 2009, who move vertices and keep the edges' directions; moving faces
// has a third of the unknowns, and normals stay exact to the bit).

#include <array>
#include <optional>
#include <vector>

#include "asset/polyhedron.h"

namespace sgm::asset {

/// Maps coordinates along an axis to their desired values: piecewise linear between its knots.
struct AxisMap {
  struct Knot {
    double from = 0, to = 0;
  };
  std::vector<Knot> knots;  ///< at least two; `from` ascends
  /// For each interval between two knots: true if every point in it must map exactly. If no interval is stiff, only the
  /// two ends of the axis must.
  std::vector<bool> stiff;

  double operator()(double at) const;
  bool isStiff(double at, double tolerance) const;
  /// True if a point that moved from `from` to `to` is still in its interval between knots, up to the tolerance.
  bool keeps(double from, double to, double tolerance) const;
  /// True if the map ascends everywhere, with no part that is almost flat.
  bool rises() const;
};

/// Fits the polyhedron, whose box begins at the origin, to the maps as well as its angles allow. Minimises the sum of
/// squared differences between the lengths of its edges and the lengths that the maps give, each weighted by the edge's
/// original length. Returns nullopt if there is no solution: constraints contradict each other, an edge would be
/// shorter than a hundredth of its original length, or a vertex would leave its interval between knots.
std::optional<Polyhedron> fitConstrained(const Polyhedron& solid, const std::array<AxisMap, 3>& maps);

}  // namespace sgm::asset

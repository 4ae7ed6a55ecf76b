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

/// The wanted target of each coordinate along an axis: piecewise linear between its knots.
struct AxisMap {
  struct Knot {
    double from = 0, to = 0;
  };
  std::vector<Knot> knots;  ///< at least two, `from` ascending
  /// For each interval between knots: true if all of it must map exactly. Otherwise only the two ends of the axis must.
  std::vector<bool> stiff;

  double operator()(double at) const;
  bool isStiff(double at, double tolerance) const;
  /// True if a point that moved from `from` to `to` stays in its interval between knots.
  bool keeps(double from, double to, double tolerance) const;
  /// True if the map ascends everywhere, and nowhere almost flat.
  bool rises() const;
};

/// Fits the polyhedron, whose box begins at the origin, to the maps as well as its angles allow: minimises the sum of
/// the squared differences between its edges' lengths and those that the maps give, each weighted by the edge's own
/// length. Returns nullopt if that is impossible: constraints contradict each other, an edge would be shorter than a
/// hundredth of its length, or a vertex would leave its interval between knots.
std::optional<Polyhedron> fitConstrained(const Polyhedron& solid, const std::array<AxisMap, 3>& maps);

}  // namespace sgm::asset

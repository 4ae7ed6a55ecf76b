#pragma once
// Resizes a polyhedron and keeps its angles: every face keeps its normal and moves along it, so edges keep their
// directions and change only their lengths. The method follows Cabral, Lefebvre, Dachsbacher and Drettakis,
// "Structure-Preserving Reshape for Textured Architectural Scenes", EG 2009, who move vertices and constrain the edges'
// directions. Moving faces instead has a third of the unknowns, and normals stay exact to the bit.

#include <array>
#include <optional>
#include <vector>

#include "asset/polyhedron.h"

namespace sgm::asset {

/// A piecewise linear map from original to desired coordinates along one axis.
struct AxisMap {
  struct Knot {
    double from = 0, to = 0;
  };
  std::vector<Knot> knots;  ///< at least two knots, with ascending `from`
  /// For each interval between two knots: true if every point in it must map exactly (a hard constraint). If no
  /// interval is stiff, only the two ends of the axis must map exactly.
  std::vector<bool> stiff;

  double operator()(double at) const;
  bool isStiff(double at, double tolerance) const;
  /// Tests a point that has moved from `from` to `to`. The knots divide the axis into intervals; one of them contains
  /// `from`. Returns true if `to` lies in the image of this interval, up to the tolerance.
  bool keeps(double from, double to, double tolerance) const;
  /// True if the map is strictly ascending, without a part that is almost flat.
  bool rises() const;
};

/// Resizes the polyhedron, whose bounding box must begin at the origin, as closely to the maps as its angles allow. The
/// result minimises the sum of squared differences between the lengths of its edges and the lengths that the maps give,
/// each weighted by the edge's original length. Returns nullopt if there is no solution: constraints contradict each
/// other, an edge would be shorter than a hundredth of its original length, or a vertex would leave its interval
/// between knots.
std::optional<Polyhedron> fitConstrained(const Polyhedron& solid, const std::array<AxisMap, 3>& maps);

}  // namespace sgm::asset

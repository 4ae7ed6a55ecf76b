#pragma once
// Closes meshes that only seem closed in a modelling tool: merges nearby points, removes slivers, and splits edges on
// which corners of other triangles lie.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "asset/point.h"
#include "base/result.h"

namespace sgm::asset {

struct WeldedTriangles {
  std::vector<Point> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  /// for each resulting triangle: the index of the original triangle of which it is a part
  std::vector<uint32_t> source;
};

/// The advice that follows an error message of weldTriangles().
inline constexpr std::string_view kOpenAdvice =
    "an asset must be closed: in the modelling tool fill its holes, merge its points and make its faces point outwards";

/// Merges points that differ by at most `tolerance` along every axis, and closes the mesh. Error: bad_input, with the
/// place of the edge, if an edge does not have equally many triangles in each direction.
Result<WeldedTriangles> weldTriangles(const std::vector<Point>& points,
                                      const std::vector<std::array<uint32_t, 3>>& triangles, double tolerance);

/// Formats a point in metres, rounded to the millimetre: "(1.5, 0, -2.25)".
std::string placeText(Point p);
/// Formats a length in metres, rounded to the millimetre: "1.5".
std::string metresText(double metres);

}  // namespace sgm::asset

#pragma once
// Closes meshes that have no visible gaps in a modelling tool: merges nearby points, removes slivers, and splits edges
// at corners of other triangles that lie on them.

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
  /// for each triangle of the result: the index of the original triangle that it is a part of
  std::vector<uint32_t> source;
};

/// The advice that follows an error of weldTriangles.
inline constexpr std::string_view kOpenAdvice =
    "an asset must be closed: in the modelling tool fill its holes, merge its points and make its faces point outwards";

/// Merges points closer than `tolerance` along every axis. Error: bad_input, with the place of the edge, if an edge
/// does not have equally many triangles on both sides.
Result<WeldedTriangles> weldTriangles(const std::vector<Point>& points,
                                      const std::vector<std::array<uint32_t, 3>>& triangles, double tolerance);

/// Formats a point in metres, to the millimetre: "(1.5, 0, -2.25)".
std::string placeText(Point p);
/// Formats a length in metres, to the millimetre: "1.5".
std::string metresText(double metres);

}  // namespace sgm::asset

#pragma once
// Closes meshes: nearby points are merged, slivers vanish, and edges are split at the corners of other triangles on
// them, so that a mesh without visible gaps in a modelling tool is closed.

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
  std::vector<uint32_t> source;  ///< for each triangle: the triangle that it is a part of
};

/// The remedy for triangles that weldTriangles rejects.
inline constexpr std::string_view kOpenAdvice =
    "an asset must be closed: in the modelling tool fill its holes, merge its points and make its faces point outwards";

/// Merges points closer than `tolerance` along every axis. Error: bad_input, naming the edge, if an edge does not have
/// equally many triangles on both sides.
Result<WeldedTriangles> weldTriangles(const std::vector<Point>& points,
                                      const std::vector<std::array<uint32_t, 3>>& triangles, double tolerance);

/// "(1.5, 0, -2.25)", metres to the millimetre.
std::string placeText(Point p);
/// "1.5", also in metres to the millimetre.
std::string metresText(double metres);

}  // namespace sgm::asset

#pragma once
// Triangles that close: points that fall together become one, slivers vanish, and edges that others' corners lie on are
// split there, so that what a modelling tool shows without a gap has none for a computer either.

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
  std::vector<uint32_t> source;  ///< of each triangle: the one it is a part of
};

/// What to do about triangles that weldTriangles refuses.
inline constexpr std::string_view kOpenAdvice =
    "an asset is closed: in the modelling tool fill its holes, merge its points and have its faces look out";

/// Points nearer than `tolerance` along every axis fall together. Errors: bad_input, where an edge has not as many
/// triangles on one side as on the other; it says which edge.
Result<WeldedTriangles> weldTriangles(const std::vector<Point>& points,
                                      const std::vector<std::array<uint32_t, 3>>& triangles, double tolerance);

/// "(1.5, 0, -2.25)", metres to the millimetre.
std::string placeText(Point p);
/// "1.5", likewise.
std::string metresText(double metres);

}  // namespace sgm::asset

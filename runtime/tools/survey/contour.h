#pragma once
// Values on a square grid, and their contour lines.

#include <limits>
#include <vector>

#include "tools/survey/drawing.h"

namespace sgm::survey {

/// Value of a point whose value is unknown: contours end beside such points.
inline constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Values at the grid points (x, y); x varies fastest.
struct Grid {
  int width = 0, height = 0;
  std::vector<float> values;

  Grid() = default;
  Grid(int columns, int rows, float value)
      : width(columns), height(rows), values(static_cast<size_t>(columns) * static_cast<size_t>(rows), value) {}
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
  float& at(int x, int y) { return values[index(x, y)]; }
  float at(int x, int y) const { return values[index(x, y)]; }
  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  /// The bilinearly interpolated value; kUnknown outside the grid, or if one of the four neighbouring values is
  /// unknown.
  float between(Point p) const;
};

/// Contours by marching squares, in grid coordinates. Larger values lie on the right of a line if y points down. The
/// last point of a closed line equals its first point.
std::vector<Line> contours(const Grid& grid, float level);

/// The boundaries of all areas above the level, as closed rings that follow the grid's border where an area reaches it.
/// Every value must be known.
std::vector<Line> areasAbove(const Grid& grid, float level);

/// Smooths a line by cutting its corners twice (Chaikin 1974). Ends of open lines stay, closed lines stay closed.
Line smoothed(const Line& line);

/// The parts of a line whose points all satisfy `wanted`.
template <class Wanted>
std::vector<Line> partsOf(const Line& line, const Wanted& wanted) {
  std::vector<Line> parts;
  Line part;
  for (const Point& p : line) {
    if (wanted(p)) {
      part.push_back(p);
      continue;
    }
    if (part.size() > 1) parts.push_back(part);
    part.clear();
  }
  if (part.size() > 1) parts.push_back(part);
  return parts;
}

/// Replaces each value by the mean of its known neighbours, and repeats this `times` times.
void soften(Grid& grid, int times);

/// Sets unknown values beside known ones to the mean of these, and repeats this `times` times.
void spread(Grid& grid, int times);

double lengthOf(const Line& line);

/// Area of the parts above 0, in grid squares, estimated from the values at the points.
double squaresAbove(const Grid& grid);

}  // namespace sgm::survey

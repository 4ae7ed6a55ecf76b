#pragma once
// Contour lines of values on a square grid.

#include <limits>
#include <vector>

#include "tools/survey/drawing.h"

namespace sgm::survey {

/// Marks a grid point without a known value. Contours end next to such points.
inline constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Values at the points (x, y) of a square grid; x varies fastest.
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
  /// The value at p by bilinear interpolation; kUnknown outside the grid, or if one of the four nearest values is
  /// unknown.
  float between(Point p) const;
};

/// The contour lines at a level, by marching squares, in grid coordinates. If y points down, larger values are on the
/// right of a line. In a closed line, the last point equals the first.
std::vector<Line> contours(const Grid& grid, float level);

/// The boundaries of all areas above the level, as closed rings. A ring follows the grid's border where its area
/// reaches the border. Contract: no value is kUnknown.
std::vector<Line> areasAbove(const Grid& grid, float level);

/// Smooths a line by two rounds of corner cutting (Chaikin 1974). The ends of an open line stay fixed; a closed line
/// stays closed.
Line smoothed(const Line& line);

/// Splits a line at the points that do not satisfy `wanted`: returns the parts in between that have at least two
/// points.
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

/// Replaces each known value by a weighted mean of itself and its known neighbours; repeats this `times` times.
void soften(Grid& grid, int times);

/// Replaces each unknown value by the mean of its known neighbours, if there are any; repeats this `times` times.
void spread(Grid& grid, int times);

double lengthOf(const Line& line);

/// Total area above 0, in grid squares, estimated from the values at the grid points.
double squaresAbove(const Grid& grid);

}  // namespace sgm::survey

#pragma once
// Values on a square grid, and their contours.

#include <limits>
#include <vector>

#include "tools/survey/drawing.h"

namespace sgm::survey {

/// Missing value: contours end beside it.
inline constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Values at points (x, y), x along rows.
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
  /// Interpolated; kUnknown if one of the four neighbours is, and outside the grid.
  float between(Point p) const;
};

/// Marching squares: lines in steps of the grid, with larger values on their right as y points down. A closed line ends
/// with its start.
std::vector<Line> contours(const Grid& grid, float level);

/// The same, closed along the grid's border: rings around all areas above the level. Every value must be known.
std::vector<Line> areasAbove(const Grid& grid, float level);

/// Cuts corners twice (Chaikin 1974); ends stay, rings stay rings.
Line smoothed(const Line& line);

/// The parts of a line whose points satisfy `wanted`.
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

/// Replaces each value by the mean of its known neighbours, `times` times.
void soften(Grid& grid, int times);

/// Fills unknown values beside known ones with the mean of these, `times` times.
void spread(Grid& grid, int times);

double lengthOf(const Line& line);

/// Area above 0 in squares of the grid, estimated from the depths of its points.
double squaresAbove(const Grid& grid);

}  // namespace sgm::survey

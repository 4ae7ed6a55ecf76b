#pragma once
// Numbers on a square grid, and the lines along which they have one value.

#include <limits>
#include <vector>

#include "tools/survey/drawing.h"

namespace sgm::survey {

/// No number: contours end beside it.
inline constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Numbers at points (x, y), x along rows.
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
  /// Between the points; kUnknown where one of the four is, and outside of the grid.
  float between(Point p) const;
};

/// Marching squares: lines in steps of the grid, with larger values on their right as y points down. A line that comes
/// back to its start ends there.
std::vector<Line> contours(const Grid& grid, float level);

/// The same, closed along the grid's border: rings around all that is above the level. Every number must be known.
std::vector<Line> areasAbove(const Grid& grid, float level);

/// Cuts corners twice (Chaikin 1974); ends stay, rings stay rings.
Line smoothed(const Line& line);

/// Parts of a line whose points are wanted.
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

/// Each number becomes the mean of those around it that are known, as often as asked for.
void soften(Grid& grid, int times);

/// Numbers beside known ones become known: the mean of these.
void spread(Grid& grid, int times);

double lengthOf(const Line& line);

/// Squares of the grid that lie above 0, by how deep their points lie.
double squaresAbove(const Grid& grid);

}  // namespace sgm::survey

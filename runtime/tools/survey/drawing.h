#pragma once
// A drawing of lines, areas and letters, for SVG files and pictures.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sgm::survey {

/// Pixels from the upper left corner, x to the right, y down.
struct Point {
  double x = 0, y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

using Line = std::vector<Point>;

struct Ink {
  uint8_t r = 0, g = 0, b = 0;
};

inline constexpr Ink kBlack{}, kWhite{255, 255, 255};

/// Lines of one pen, or areas of one colour.
struct Mark {
  std::string_view name;    ///< static; the meaning of the mark, as the class of its SVG element: "wall"
  std::vector<Line> lines;  ///< of an area: rings, closed automatically, filled by the even-odd rule
  bool filled = false;
  Ink ink = kBlack;
  double width = 1;            ///< of the pen, pixels
  std::vector<double> dashes;  ///< alternating lengths drawn and skipped; empty: a solid line
  std::string text;            ///< of lettering, whose strokes are the lines
};

/// White paper with marks, painted in order.
struct Drawing {
  int width = 0, height = 0;
  std::vector<Mark> marks;
};

/// The parts of a line that these dashes draw. Precondition: the dashes' sum is positive, or the list is empty.
std::vector<Line> dashed(const Line& line, const std::vector<double>& dashes);

}  // namespace sgm::survey

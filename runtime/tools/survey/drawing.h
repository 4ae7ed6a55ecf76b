#pragma once
// A drawing of lines, areas and lettering, which is written as an SVG file or as a picture.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sgm::survey {

/// A position in pixels from the upper left corner, x to the right, y down.
struct Point {
  double x = 0, y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

using Line = std::vector<Point>;

struct Ink {
  uint8_t r = 0, g = 0, b = 0;
};

inline constexpr Ink kBlack{}, kWhite{255, 255, 255};

/// Lines drawn with one pen, or areas filled with one colour.
struct Mark {
  /// Name of the mark's meaning, such as "wall", used as the class of its SVG element; a string literal.
  std::string_view name;
  std::vector<Line> lines;  ///< for an area: rings, closed automatically, filled by the even-odd rule
  bool filled = false;
  Ink ink = kBlack;
  double width = 1;            ///< width of the pen, pixels
  std::vector<double> dashes;  ///< alternating lengths that are drawn and skipped, pixels; empty: a solid line
  std::string text;            ///< for lettering: the text whose strokes the lines are
};

/// A sheet of white paper, on which the marks are painted in order.
struct Drawing {
  int width = 0, height = 0;
  std::vector<Mark> marks;
};

/// The parts of a line that a dash pattern draws. Precondition: the sum of the dashes is positive, or there are none.
std::vector<Line> dashed(const Line& line, const std::vector<double>& dashes);

}  // namespace sgm::survey

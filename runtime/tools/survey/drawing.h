#pragma once
// A vector drawing of lines, areas and text, which can be written as SVG or rasterized.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sgm::survey {

/// A position in pixels from the upper left corner; x points right, y points down.
struct Point {
  double x = 0, y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

using Line = std::vector<Point>;

struct Ink {
  uint8_t r = 0, g = 0, b = 0;
};

inline constexpr Ink kBlack{}, kWhite{255, 255, 255};

/// Lines of one pen width and colour, or areas of one colour.
struct Mark {
  /// Name of the mark's meaning, such as "wall", which becomes the class of its SVG element; must be a string literal.
  std::string_view name;
  std::vector<Line> lines;  ///< for areas: rings, which are closed automatically and filled by the even-odd rule
  bool filled = false;
  Ink ink = kBlack;
  double width = 1;            ///< width of the pen in pixels
  std::vector<double> dashes;  ///< lengths in pixels, alternately drawn and skipped; empty: solid line
  std::string text;            ///< for lettering: the text that the lines spell
};

/// A white sheet with marks. The marks are painted in the order of the list, so later marks lie on top.
struct Drawing {
  int width = 0, height = 0;
  std::vector<Mark> marks;
};

/// Cuts a line into the dashes of a pattern. Contract: `dashes` is empty or has a positive sum.
std::vector<Line> dashed(const Line& line, const std::vector<double>& dashes);

}  // namespace sgm::survey

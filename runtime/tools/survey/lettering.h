#pragma once
// Letters as pen strokes, which are identical in SVG files and pictures, and independent of installed fonts.

#include <string_view>

#include "tools/survey/drawing.h"

namespace sgm::survey {

enum class Align { left, middle, right };

/// Width of the text in pixels. height: height of capital letters, pixels.
double letterWidth(std::string_view text, double height);

/// The strokes of a text whose baseline is at `at`. Characters beyond ASCII are drawn as question marks. height: height
/// of capital letters, pixels.
Mark lettering(std::string_view text, Point at, double height, Align align = Align::left, Ink ink = kBlack);

}  // namespace sgm::survey

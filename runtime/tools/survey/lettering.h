#pragma once
// Letters as pen strokes: identical in SVG files and pixels, independent of installed fonts.

#include <string_view>

#include "tools/survey/drawing.h"

namespace sgm::survey {

enum class Align { left, middle, right };

/// Width of the text in pixels, with capitals of this height.
double letterWidth(std::string_view text, double height);

/// The text with its baseline at `at`. Characters beyond ASCII are drawn as question marks. height: of capitals.
Mark lettering(std::string_view text, Point at, double height, Align align = Align::left, Ink ink = kBlack);

}  // namespace sgm::survey

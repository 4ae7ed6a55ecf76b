#pragma once
// Text as pen strokes: it looks the same in SVG files and pictures, and does not depend on installed fonts.

#include <string_view>

#include "tools/survey/drawing.h"

namespace sgm::survey {

enum class Align { left, middle, right };

/// Width of a text in pixels. height: height of capital letters in pixels.
double letterWidth(std::string_view text, double height);

/// The strokes of a text. at: point on the baseline, at the text's left end, middle or right end, depending on `align`.
/// height: height of capital letters in pixels. Characters beyond ASCII are drawn as question marks.
Mark lettering(std::string_view text, Point at, double height, Align align = Align::left, Ink ink = kBlack);

}  // namespace sgm::survey

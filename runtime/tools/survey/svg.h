#pragma once
// Writes a drawing as an SVG file.

#include <string>

#include "tools/survey/drawing.h"

namespace sgm::survey {

/// Every mark is a path whose class is its name. Lettering has its text as a label for screen readers and searches.
/// title: of the whole file.
std::string svgText(const Drawing& drawing, std::string_view title);

}  // namespace sgm::survey

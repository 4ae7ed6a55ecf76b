#pragma once
// A drawing as the text of an SVG file.

#include <string>

#include "tools/survey/drawing.h"

namespace sgm::survey {

/// Every mark is a path whose class is its name. Lettering has its text as the label that readers of screens, and
/// searches, find. title: of the whole file.
std::string svgText(const Drawing& drawing, std::string_view title);

}  // namespace sgm::survey

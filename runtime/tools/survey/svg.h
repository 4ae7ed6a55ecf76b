#pragma once
// Writes a drawing as an SVG file.

#include <string>

#include "tools/survey/drawing.h"

namespace sgm::survey {

/// The drawing as an SVG file. Each mark becomes a path whose class is the mark's name. Lettering also gets its text as
/// a label, for screen readers and search. title: title of the file.
std::string svgText(const Drawing& drawing, std::string_view title);

}  // namespace sgm::survey

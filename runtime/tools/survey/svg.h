#pragma once
// Writes a drawing as an SVG file.

#include <string>

#include "tools/survey/drawing.h"

namespace sgm::survey {

/// The text of an SVG file. Every mark becomes a path whose class is the mark's name. Lettering gets its text as a
/// label for screen readers and searches. title: title of the whole file.
std::string svgText(const Drawing& drawing, std::string_view title);

}  // namespace sgm::survey

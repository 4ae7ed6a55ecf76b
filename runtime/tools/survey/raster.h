#pragma once
// Rasterises a drawing with antialiasing. The same drawing gives the same pixels on every machine.

#include "tools/render/image.h"
#include "tools/survey/drawing.h"

namespace sgm::survey {

/// Draws the marks over an existing picture.
void drawOnto(Image& image, const std::vector<Mark>& marks);

/// Draws the drawing on white paper.
Image rasterise(const Drawing& drawing);

}  // namespace sgm::survey

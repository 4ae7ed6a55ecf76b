#pragma once
// Rasterizes a drawing with antialiasing. The same drawing gives the same pixels on every machine.

#include "tools/render/image.h"
#include "tools/survey/drawing.h"

namespace sgm::survey {

/// Paints marks over an existing picture.
void drawOnto(Image& image, const std::vector<Mark>& marks);

/// Paints the whole drawing on white.
Image rasterise(const Drawing& drawing);

}  // namespace sgm::survey

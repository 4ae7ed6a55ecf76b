#pragma once
// A drawing as pixels, with smooth edges. The same drawing gives the same pixels on every machine.

#include "tools/render/image.h"
#include "tools/survey/drawing.h"

namespace sgm::survey {

/// Draws the marks onto a picture, over what is there.
void drawOnto(Image& image, const std::vector<Mark>& marks);

/// The drawing on white.
Image rasterise(const Drawing& drawing);

}  // namespace sgm::survey

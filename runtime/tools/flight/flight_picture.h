#pragma once
// Pictures of the chunks that a flight has drawn.

#include <sgm/sgm.h>

#include <span>
#include <vector>

#include "tools/flight/flight_curve.h"
#include "tools/render/camera.h"
#include "tools/render/renderer.h"

namespace sgm::cli {

/// A chunk as it is drawn: its body, and the seams whose bits (1u << sgm_face) are set.
struct PicturedChunk {
  sgm_mesh_view mesh = SGM_MESH_VIEW_INIT;
  uint32_t seams = 0;
};

struct PictureWish {
  FlightPlace camera;
  double fov_degrees = 68;  ///< across the picture's height
  int width = 640, height = 360;
  Light light = Light::sun;
  double depth = 20;  ///< typical distance in metres of visible surfaces: sets the reach of the lamp and the density of
                      ///< haze
  /// Draws each level of detail in its own colour, brightly lit; otherwise materials in `light`.
  bool levels = false;
};

/// Draws the chunks from the camera. Under Light::lamp there is only the camera's own lamp, since others would jump
/// from picture to picture. Errors: those of Renderer::render.
Result<Image> drawChunks(const Renderer& renderer, const sgm_grammar* grammar, std::span<const PicturedChunk> chunks,
                         const PictureWish& wish);

/// All images on one sheet, row by row, with margins; each has the space of the largest. Empty without images.
/// Precondition: columns is positive.
Image contactSheet(std::span<const Image> images, int columns);

}  // namespace sgm::cli

#pragma once
// Pictures of the chunks that are drawn in a flight.

#include <sgm/sgm.h>

#include <span>
#include <vector>

#include "tools/flight/flight_curve.h"
#include "tools/render/camera.h"
#include "tools/render/renderer.h"

namespace sgm::cli {

/// A drawn chunk: its body, and those of its seams whose bits (1u << sgm_face) are set in `seams`.
struct PicturedChunk {
  sgm_mesh_view mesh = SGM_MESH_VIEW_INIT;
  uint32_t seams = 0;
};

struct PictureRequest {
  FlightPlace camera;
  double fov_degrees = 68;  ///< across the picture's height
  int width = 640, height = 360;
  Light light = Light::sun;
  /// Typical distance in metres of visible surfaces; sets the reach of the lamp and the density of haze.
  double depth = 20;
  /// Draws each level of detail in its own colour, brightly lit; otherwise materials in `light`.
  bool levels = false;
};

/// Draws the chunks as the camera sees them. Under Light::lamp the camera's own lamp is the only one, since other lamps
/// would change their places from picture to picture. Errors: those of Renderer::render.
Result<Image> drawChunks(const Renderer& renderer, const sgm_grammar* grammar, std::span<const PicturedChunk> chunks,
                         const PictureRequest& request);

/// All images on one sheet, row by row, with margins; each place has the size of the largest image. Empty if there are
/// no images. Precondition: columns > 0.
Image contactSheet(std::span<const Image> images, int columns);

}  // namespace sgm::cli

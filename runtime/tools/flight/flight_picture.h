#pragma once
// Draws pictures of the chunks that are visible during a flight.

#include <sgm/sgm.h>

#include <span>
#include <vector>

#include "tools/flight/flight_curve.h"
#include "tools/render/camera.h"
#include "tools/render/renderer.h"

namespace sgm::cli {

/// A chunk to draw: its body, and the seams whose bits (1u << sgm_face) are set in `seams`.
struct PicturedChunk {
  sgm_mesh_view mesh = SGM_MESH_VIEW_INIT;
  uint32_t seams = 0;
};

struct PictureRequest {
  FlightPlace camera;
  double fov_degrees = 68;  ///< vertical field of view
  int width = 640, height = 360;
  Light light = Light::sun;
  /// Typical distance of visible surfaces, in metres; determines the reach of the lamp and the density of haze.
  double depth = 20;
  /// true: draws each level of detail in its own colour, brightly lit; false: draws materials lit by `light`.
  bool levels = false;
};

/// Draws the chunks as the camera sees them. With Light::lamp, the only lamp is at the camera, since lamps placed
/// elsewhere would move from picture to picture. Errors: those of Renderer::render.
Result<Image> drawChunks(const Renderer& renderer, const sgm_grammar* grammar, std::span<const PicturedChunk> chunks,
                         const PictureRequest& request);

/// Arranges images on one sheet, row by row, with margins; each gets the space of the largest image. Empty if there are
/// no images. Precondition: columns > 0.
Image contactSheet(std::span<const Image> images, int columns);

}  // namespace sgm::cli

#pragma once
// Pictures of what a flight has drawn.

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
  double depth = 20;  ///< typical distance in metres to what is seen: how far the lamp reaches, and how thick haze is
  /// Each level of detail in a colour of its own, brightly lit; else materials, in that light.
  bool levels = false;
};

/// The picture that the camera has of the chunks. Under Light::lamp the camera's own lamp is the only one: others would
/// jump from picture to picture. Errors: those of Renderer::render.
Result<Image> drawChunks(const Renderer& renderer, const sgm_grammar* grammar, std::span<const PicturedChunk> chunks,
                         const PictureWish& wish);

/// All images on one, row by row, with a margin between them; every one has the room of the largest. Precondition:
/// columns is positive. No image for none.
Image contactSheet(std::span<const Image> images, int columns);

}  // namespace sgm::cli

#pragma once
// Automatic choice of a camera, and its light.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/result.h"
#include "tools/render/scene.h"

namespace sgm {

struct CameraWish {
  int width = 1280;
  int height = 720;
  float fov_degrees = 68;
  /// Places to stand at, metres from the scene's origin; of those in the void, the one with the best view is chosen.
  std::span<const glm::vec3> anchors;
  bool airborne = false;  ///< the shape floats: from outside, look up at it
};

/// A camera, and what is known about its view.
struct View {
  RenderCamera camera;
  bool enclosed = false;          ///< inside a void, walls all around; else the shape is seen from outside
  bool at_anchor = false;         ///< in the room or cave of a requested anchor
  float depth = 1;                ///< typical distance in metres of visible surfaces
  std::vector<RenderLamp> lamps;  ///< already in the scene, otherwise hung in the void, deeper along the view: for
                                  ///< Light::lamp
};

/// The light of a picture. The mesh alone does not determine it (a street has walls, as a cave has): callers decide.
enum class Light : uint32_t {
  sun,   ///< and the sky
  lamp,  ///< on the explorer's helmet, and View::lamps
  none,  ///< neither: even light from all sides, which shows only form
};

/// Chooses a view of the mesh: from inside the void if the mesh encloses one (at an anchor if there is one), where
/// space is widest and the view deep and varied; otherwise the whole shape, three quarters from above (from below if it
/// floats). The same mesh and wish give the same view. Errors: invalid_argument if there is no triangle; out_of_memory.
Result<View> chooseCamera(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                          const CameraWish& wish);

/// The view of a given camera: its depth, whether walls surround it, and places for lamps.
/// Error: out_of_memory.
Result<View> viewFrom(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                      const RenderCamera& camera);

/// Sets the scene's camera, lamps, fog, exposure and background to suit the view.
void lightScene(const View& view, Light light, RenderScene& scene);

}  // namespace sgm

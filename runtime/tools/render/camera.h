#pragma once
// Chooses a camera automatically, and its light.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/result.h"
#include "tools/render/scene.h"

namespace sgm {

struct CameraRequest {
  int width = 1280;
  int height = 720;
  float fov_degrees = 68;
  /// Preferred camera positions, metres from the scene's origin. Among those in the void, the position with the best
  /// view is chosen.
  std::span<const glm::vec3> anchors;
  bool airborne = false;  ///< the shape floats: from outside, the camera looks up at it
};

/// A camera, and properties of its view.
struct View {
  RenderCamera camera;
  /// The camera is inside a void with walls all around; otherwise it sees the shape from outside.
  bool enclosed = false;
  bool at_anchor = false;  ///< the camera is in the room or cave of a requested anchor
  float depth = 1;         ///< typical distance in metres of visible surfaces
  /// Lamps for Light::lamp: those already in the scene, otherwise lamps hung in the void further along the view.
  std::vector<RenderLamp> lamps;
};

/// The light of a picture. Callers choose it, because the mesh alone does not determine it: a street has walls, as a
/// cave has.
enum class Light : uint32_t {
  sun,   ///< sun and sky
  lamp,  ///< the lamp on the explorer's helmet, and View::lamps
  none,  ///< no light source: even light from all sides, which shows only the shape
};

/// Chooses a view of the mesh. If the mesh encloses a void, the camera is inside it (at an anchor if there is one),
/// where the space is widest and the view deep and varied. Otherwise it shows the whole shape, obliquely from above
/// (from below if the shape floats). The same mesh and wish give the same view. Errors: invalid_argument if there is no
/// triangle; out_of_memory.
Result<View> chooseCamera(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                          const CameraRequest& request);

/// Determines the properties of a given camera's view: its depth, whether walls surround the camera, and places for
/// lamps.
/// Error: out_of_memory.
Result<View> viewFrom(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                      const RenderCamera& camera);

/// Sets the scene's camera, lamps, fog, exposure and background to suit the view.
void lightScene(const View& view, Light light, RenderScene& scene);

}  // namespace sgm

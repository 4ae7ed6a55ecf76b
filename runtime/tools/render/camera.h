#pragma once
// Chooses a camera and its lights automatically.

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
  /// Preferred camera positions, in metres from the scene's origin. Anchors outside the void are ignored; of the
  /// others, the one with the best view is chosen.
  std::span<const glm::vec3> anchors;
  bool airborne = false;  ///< true if the shape floats in the air: a camera outside of the shape then looks up at it
};

/// A camera, and properties of its view.
struct View {
  RenderCamera camera;
  /// True if the camera is inside a void with walls all around; false if it sees the shape from outside.
  bool enclosed = false;
  bool at_anchor = false;  ///< true if the camera stands at one of CameraRequest::anchors
  float depth = 1;         ///< typical distance in metres from the camera to the visible surfaces
  /// Lamps for Light::lamp, placed in the void along the view. The caller may replace them.
  std::vector<RenderLamp> lamps;
};

/// The kind of light in a picture. The caller chooses it, because it does not follow from the mesh: both a street and a
/// cave have walls.
enum class Light : uint32_t {
  sun,   ///< sun and sky
  lamp,  ///< the lamp on the explorer's helmet, and the lamps in View::lamps
  none,  ///< no light source: equal light from all sides, which shows only the shape
};

/// Chooses a view of the mesh. If the mesh encloses a void, the camera is inside it: at an anchor if one is in the
/// void, otherwise where the space is widest and the view deep and varied. If there is no void, the camera shows the
/// whole shape from outside. The same mesh and request give the same view. Errors: invalid_argument if the mesh has no
/// triangle; out_of_memory.
Result<View> chooseCamera(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                          const CameraRequest& request);

/// The view of a given camera: its depth, whether walls surround the camera, and places for lamps. Error:
/// out_of_memory.
Result<View> viewFrom(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                      const RenderCamera& camera);

/// Sets the scene's camera, lamps, fog, exposure and background to match the view and the kind of light.
void lightScene(const View& view, Light light, RenderScene& scene);

}  // namespace sgm

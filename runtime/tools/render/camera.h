#pragma once
// A camera that finds its own place, and the light that goes with it.

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
  /// Places to stand at, metres from the scene's origin; of those that lie in the void the one with the
  /// best view is taken.
  std::span<const glm::vec3> anchors;
  bool airborne = false;  ///< a shape seen from outside floats: look up at it
};

/// A place to look from, and what was learnt about it.
struct View {
  RenderCamera camera;
  bool enclosed = false;          ///< inside a void, walls all around; else the shape is seen from outside
  bool at_anchor = false;         ///< in the room or cave of an anchor that was wished for
  float depth = 1;                ///< typical distance in metres to what is seen
  std::vector<RenderLamp> lamps;  ///< built there, else in the void, deeper along the view: for Light::lamp
};

/// What lights a picture. The mesh alone does not tell (a street is walled as a cave is): callers decide.
enum class Light : uint32_t {
  sun,   ///< and the sky
  lamp,  ///< on the explorer's helmet, and View::lamps
  none,  ///< neither: even light from everywhere, which shows form alone
};

/// Looks for a view in the mesh: from inside the void where the mesh encloses one (at an anchor if there is one), where
/// the space is widest and the view deep and varied; else the whole shape, three quarters from above (from below
/// where it floats). The same mesh and
/// wish give the same view. Errors: invalid_argument where there is no triangle;
/// out_of_memory.
Result<View> chooseCamera(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                          const CameraWish& wish);

/// The view of a given camera: how deep it looks, whether walls are all around it, where lamps would go.
/// Error: out_of_memory.
Result<View> viewFrom(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                      const RenderCamera& camera);

/// Sets the scene's camera, lamps, fog, exposure and background to suit the view.
void lightScene(const View& view, Light light, RenderScene& scene);

}  // namespace sgm

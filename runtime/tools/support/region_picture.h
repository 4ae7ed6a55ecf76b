#pragma once
// A picture of a meshed region, for `sgm render` and `sgm paper`.

#include <optional>
#include <string_view>

#include "tools/flight/daylight.h"
#include "tools/render/camera.h"
#include "tools/render/renderer.h"
#include "tools/support/framed_use.h"
#include "tools/support/region.h"
#include "tools/support/region_density.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

struct RegionPicture {
  Image image;
  View view;
  Light light = Light::sun;
  std::optional<double> daylight;   ///< if it has decided on the light
  std::optional<FramedUse> framed;  ///< if --frame asks for a use of a rule
};

/// A region ready to be drawn, from the camera of the options.
struct RegionScene {
  std::vector<RenderVertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<RenderMaterial> materials;
  RenderScene scene;  ///< refers to these three, so this struct can be moved but not copied
  View view;
  Light light = Light::sun;
  std::optional<double> daylight;   ///< if it has decided on the light
  std::optional<FramedUse> framed;  ///< if --frame asks for a use of a rule

  RegionScene() = default;
  RegionScene(RegionScene&&) = default;
  RegionScene& operator=(RegionScene&&) = default;
};

/// The camera's position and target in metres of the world. origin: of the scene in which the camera is given.
Gaze worldGaze(const RenderCamera& camera, Int3 origin);
/// The gaze as an argument of --camera, rounded to a tenth of a millimetre.
std::string gazeText(const Gaze& gaze);

/// Places of the region's anchors of that name, kind or tag, metres from its mesh's origin; without those that its
/// border hides, unless it hides all.
std::vector<glm::vec3> anchorsAt(const Region& region, std::string_view wanted);

/// The plan of a mesh for a picture: chooses the part of an endless world that the options mean, and samples `density`
/// if they ask for fog. Both must outlive the plan.
RegionPlan picturePlan(const RenderOptions& options, std::optional<RegionDensity>& density);

/// The region's surface, from the camera of the options, or from where most of it is seen. Contract and errors as for
/// drawRegion(), except the errors of Renderer. Without a texture, each triangle has one material.
Result<RegionScene> sceneOf(const RenderOptions& options, const Region& region);

/// A picture of the region, from the camera of the options, or from where most of it is seen. Contract: it was meshed
/// by picturePlan() and has a triangle. Errors: invalid_argument if position and target of the camera coincide; those
/// of Renderer.
Result<RegionPicture> drawRegion(const Renderer& renderer, const RenderOptions& options, const Region& region,
                                 const std::optional<RegionDensity>& density);

}  // namespace sgm::cli

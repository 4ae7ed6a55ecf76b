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
  std::optional<double> daylight;   ///< the measured share of visible sky, if it has decided on the light
  std::optional<FramedUse> framed;  ///< the shown use of a rule, if --frame requests one
};

/// A region ready to be drawn as seen by the camera that the options give or that was chosen.
struct RegionScene {
  std::vector<RenderVertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<RenderMaterial> materials;
  RenderScene scene;  ///< refers to the three members above, so this struct can be moved but not copied
  View view;
  Light light = Light::sun;
  std::optional<double> daylight;   ///< the measured share of visible sky, if it has decided on the light
  std::optional<FramedUse> framed;  ///< the shown use of a rule, if --frame requests one

  RegionScene() = default;
  RegionScene(RegionScene&&) = default;
  RegionScene& operator=(RegionScene&&) = default;
};

/// The camera's position and target in metres of the world. origin: world position, in units, of the scene to which the
/// camera belongs.
Gaze worldGaze(const RenderCamera& camera, Int3 origin);
/// The gaze in the form of --camera, rounded to a tenth of a millimetre.
std::string gazeText(const Gaze& gaze);

/// Places of the region's anchors with that name, kind or tag, in metres from the mesh's origin. Anchors from which the
/// region's border would be visible are omitted, unless all are.
std::vector<glm::vec3> anchorsAt(const Region& region, std::string_view wanted);

/// The plan for meshing a region of which a picture is drawn: chooses the part of an endless world according to the
/// options, and samples `density` if they request fog. Options and density must outlive the plan.
RegionPlan picturePlan(const RenderOptions& options, std::optional<RegionDensity>& density);

/// The scene of the region's surface. The camera is that of the options, or chosen to see most of the surface. Contract
/// and errors as for drawRegion(), except the errors of Renderer. If the region has no texture, each triangle has one
/// material.
Result<RegionScene> sceneOf(const RenderOptions& options, const Region& region);

/// A picture of the region. The camera is that of the options, or chosen to see most of the surface. Contract: the
/// region was meshed with the plan of picturePlan() and has a triangle. Errors: invalid_argument if position and target
/// of the camera coincide; those of Renderer.
Result<RegionPicture> drawRegion(const Renderer& renderer, const RenderOptions& options, const Region& region,
                                 const std::optional<RegionDensity>& density);

}  // namespace sgm::cli

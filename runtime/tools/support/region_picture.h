#pragma once
// Draws a picture of a meshed region, for `sgm render` and `sgm paper`.

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
  std::optional<double> daylight;   ///< measured share of visible sky; nullopt if `light` was chosen without measuring
                                    ///< the sky
  std::optional<FramedUse> framed;  ///< with --frame: the use of a rule that the picture shows
};

/// A region ready to be drawn, with its camera and light.
struct RegionScene {
  std::vector<RenderVertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<RenderMaterial> materials;
  RenderScene scene;  ///< points into the heap buffers of the three vectors above: a move of this struct keeps these
                      ///< buffers, a copy would not
  View view;
  Light light = Light::sun;
  std::optional<double> daylight;   ///< measured share of visible sky; nullopt if `light` was chosen without measuring
                                    ///< the sky
  std::optional<FramedUse> framed;  ///< with --frame: the use of a rule that the picture shows

  RegionScene() = default;
  RegionScene(RegionScene&&) = default;
  RegionScene& operator=(RegionScene&&) = default;
};

/// Position and target of a camera in world coordinates, metres. origin: world position of the scene's origin, in
/// units.
Gaze worldGaze(const RenderCamera& camera, Int3 origin);
/// Position and target as a value for --camera, rounded to a tenth of a millimetre.
std::string gazeText(const Gaze& gaze);

/// Places of the region's anchors with the name, kind or tag `wanted`, in metres from the mesh's origin. Anchors near
/// the region's border are omitted, unless all are: a picture from there would show the border.
std::vector<glm::vec3> anchorsAt(const Region& region, std::string_view wanted);

/// The plan for meshing a region for a picture. Chooses a part of an endless world according to the options, and
/// samples the density of fog into `density` with --volume. Contract: options and density outlive the plan.
RegionPlan picturePlan(const RenderOptions& options, std::optional<RegionDensity>& density);

/// The scene that shows the region's surface. The camera is that of the options, or chosen to see most of the surface.
/// Contract and errors: those of drawRegion(), but no errors of Renderer.
Result<RegionScene> sceneOf(const RenderOptions& options, const Region& region);

/// Draws a picture of the region. The camera is that of the options, or chosen to see most of the surface. Contract:
/// the region was meshed with the plan of picturePlan() and has a triangle. Errors: invalid_argument if position and
/// target of the camera are equal; those of frameUse() with --frame; those of Renderer.
Result<RegionPicture> drawRegion(const Renderer& renderer, const RenderOptions& options, const Region& region,
                                 const std::optional<RegionDensity>& density);

}  // namespace sgm::cli

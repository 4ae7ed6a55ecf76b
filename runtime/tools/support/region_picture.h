#pragma once
// A meshed region as a picture: what `sgm render` writes, and what `sgm paper` shows.

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
  std::optional<double> daylight;   ///< where that has decided on the light
  std::optional<FramedUse> framed;  ///< where --frame asks for a use of a rule
};

/// A region as it is to be drawn, from where the options look.
struct RegionScene {
  std::vector<RenderVertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<RenderMaterial> materials;
  RenderScene scene;  ///< of these three, which may be moved, but not copied
  View view;
  Light light = Light::sun;
  std::optional<double> daylight;   ///< where that has decided on the light
  std::optional<FramedUse> framed;  ///< where --frame asks for a use of a rule

  RegionScene() = default;
  RegionScene(RegionScene&&) = default;
  RegionScene& operator=(RegionScene&&) = default;
};

/// From where and to where a camera looks, in metres of the world, whatever its scene's origin.
Gaze worldGaze(const RenderCamera& camera, Int3 origin);
/// As --camera takes it, to a tenth of a millimetre.
std::string gazeText(const Gaze& gaze);

/// Places of the region's anchors of that name, kind or tag, metres from its mesh's origin; of those that its border
/// does not hide where there are such.
std::vector<glm::vec3> anchorsAt(const Region& region, std::string_view wanted);

/// What the mesh must be made with for a picture: the part of an endless world that the options mean, and the density
/// where they ask for fog, which goes to `density`. Both must outlive the plan.
RegionPlan picturePlan(const RenderOptions& options, std::optional<RegionDensity>& density);

/// The region's surface, from where the options look, or from where most of it is seen. Contract and errors as those of
/// drawRegion(), but those of Renderer. A region without a texture is drawn in one material a triangle.
Result<RegionScene> sceneOf(const RenderOptions& options, const Region& region);

/// A picture of the region, from where the options look, or from where most of it is seen. Contract: it was meshed by
/// picturePlan() and has a triangle. Errors: invalid_argument for a camera that looks nowhere; those of Renderer.
Result<RegionPicture> drawRegion(const Renderer& renderer, const RenderOptions& options, const Region& region,
                                 const std::optional<RegionDensity>& density);

}  // namespace sgm::cli

#pragma once
// Implements `sgm render --frame`: chooses the region and the camera so that the picture shows a use of a rule (one
// place at which the grammar's derivation applies the rule).

#include <optional>
#include <span>
#include <string>

#include "tools/render/camera.h"
#include "tools/support/region.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// A use of a rule (one place at which derivation applies the rule), as a picture shows it.
struct FramedUse {
  std::string path;
  IntBox bounds;  ///< bounding box of the shapes that the rule produces at this place, units
  /// True if the rule's shapes at this place are hollow, such as a room, and the camera is inside. `seen` and `fill`
  /// are then 1.
  bool inside = false;
  double seen = 0;  ///< share of the surfaces of the rule's shapes that face the camera and are not hidden
  double fill = 0;  ///< share of the picture's width or height that the rule's shapes take up
};

Json toJson(const FramedUse& use);
std::string textOf(const FramedUse& use);

/// Changes the plan so that an unknown rule is rejected, and the region surrounds the use of the rule that is nearest
/// to the origin. Contract: the options outlive the plan.
void planFrame(const RenderOptions& options, RegionPlan& plan);

/// Returns the view in which a use of the rule is most visible; sets `framed` to that use. Contract: the region was
/// meshed with the plan of planFrame(). Errors: invalid_argument if the region contains no use, or no visible one;
/// those of derivation.
Result<View> frameUse(const RenderOptions& options, const Region& region, std::span<const RenderVertex> vertices,
                      std::span<const uint32_t> indices, std::optional<FramedUse>& framed);

}  // namespace sgm::cli

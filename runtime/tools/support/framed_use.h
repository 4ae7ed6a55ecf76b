#pragma once
// `sgm render --frame`: chooses the region and the camera that show a use of a rule.

#include <optional>
#include <span>
#include <string>

#include "tools/render/camera.h"
#include "tools/support/region.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// The use of a rule that a picture shows.
struct FramedUse {
  std::string path;
  IntBox bounds;  ///< bounds of the use's shapes, units
  /// Whether the use is a hollow that encloses the camera; otherwise `seen` and `fill` are valid:
  bool inside = false;
  double seen = 0;  ///< share of the use's surfaces facing the camera that nothing hides
  double fill = 0;  ///< share of the picture's height or width that the use fills
};

Json toJson(const FramedUse& use);
std::string textOf(const FramedUse& use);

/// Extends the plan: an unknown rule is rejected, and the region is chosen around the use nearest to the origin. The
/// options must outlive the plan.
void planFrame(const RenderOptions& options, RegionPlan& plan);

/// The view of the use that is most visible. Contract: the region was meshed with the plan of planFrame(). Errors:
/// invalid_argument if the region contains no use, or no visible use; errors of derivation.
Result<View> frameUse(const RenderOptions& options, const Region& region, std::span<const RenderVertex> vertices,
                      std::span<const uint32_t> indices, std::optional<FramedUse>& framed);

}  // namespace sgm::cli

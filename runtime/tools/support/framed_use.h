#pragma once
// `sgm render --frame`, from the options to a camera.

#include <optional>
#include <span>
#include <string>

#include "tools/render/camera.h"
#include "tools/support/region.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// The use that a picture shows.
struct FramedUse {
  std::string path;
  IntBox bounds;        ///< units
  bool inside = false;  ///< whether the use is a hollow that encloses the camera; if not:
  double seen = 0;      ///< visible share of its near side
  double fill = 0;      ///< share of the picture's height or width that it fills
};

Json toJson(const FramedUse& use);
std::string textOf(const FramedUse& use);

/// Makes the plan reject an unknown rule, and choose a region around the use nearest to the origin. The options must
/// outlive the plan.
void planFrame(const RenderOptions& options, RegionPlan& plan);

/// A view of the use that is seen best. Contract: the region was meshed by planFrame()'s plan. Errors: invalid_argument
/// if the region has no use, or no visible one; errors of derivation.
Result<View> frameUse(const RenderOptions& options, const Region& region, std::span<const RenderVertex> vertices,
                      std::span<const uint32_t> indices, std::optional<FramedUse>& framed);

}  // namespace sgm::cli

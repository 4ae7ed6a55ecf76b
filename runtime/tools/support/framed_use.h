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
  bool inside = false;  ///< it is a hollow that the camera stands in; otherwise:
  double seen = 0;      ///< share of its near side in sight
  double fill = 0;      ///< of the picture's height or width
};

Json toJson(const FramedUse& use);
std::string textOf(const FramedUse& use);

/// Has the plan refuse a rule that is not there, and choose a region around the use nearest to the origin. The options
/// must outlive the plan.
void planFrame(const RenderOptions& options, RegionPlan& plan);

/// A view of the use that is seen best. Contract: the region was meshed by planFrame()'s plan. Errors: invalid_argument
/// where the region has no use, or shows none; those of derivation.
Result<View> frameUse(const RenderOptions& options, const Region& region, std::span<const RenderVertex> vertices,
                      std::span<const uint32_t> indices, std::optional<FramedUse>& framed);

}  // namespace sgm::cli

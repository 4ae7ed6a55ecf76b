#pragma once
// Checks whether a picture of a region can be drawn: it needs a surface, and the anchor that --at names.

#include <span>
#include <string>

#include "tools/support/region.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// Checks that at least one anchor has the name, kind or tag `wanted`. An empty `wanted` is always accepted. Error:
/// invalid_argument.
Result<void> checkAnchor(const Program& program, std::span<const Anchor> anchors, const std::string& wanted);

/// Error: invalid_argument if the region has no surface, or no anchor with the name, kind or tag in --at.
Result<void> checkDrawable(const RenderOptions& options, const Region& region);

}  // namespace sgm::cli

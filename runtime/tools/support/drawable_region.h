#pragma once
// Checks that a region has the surface and the anchors that a picture of it needs.

#include <span>
#include <string>

#include "tools/support/region.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// Checks that an anchor has the wanted name, kind or tag; an empty `wanted` accepts everything. Error:
/// invalid_argument if there is none.
Result<void> checkAnchor(const Program& program, std::span<const Anchor> anchors, const std::string& wanted);

/// Error: invalid_argument if the region has no surface, or lacks the anchor that --at names.
Result<void> checkDrawable(const RenderOptions& options, const Region& region);

}  // namespace sgm::cli

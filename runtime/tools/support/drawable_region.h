#pragma once
// Checks that a region has the surface and the anchors that a picture needs.

#include <span>
#include <string>

#include "tools/support/region.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// Error: invalid_argument if no anchor has the wanted name, kind or tag. An empty name accepts all.
Result<void> checkAnchor(const Program& program, std::span<const Anchor> anchors, const std::string& wanted);

/// Error: invalid_argument if the region has no surface, or not the anchor that --at names.
Result<void> checkDrawable(const RenderOptions& options, const Region& region);

}  // namespace sgm::cli

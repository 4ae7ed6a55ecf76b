#pragma once
// The command `sgm preview`.

#include "tools/support/console.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// Shows the preview window until the user closes it. Has the same options as a single picture of `sgm render`.
Exit showPreview(const RenderOptions& options);

}  // namespace sgm::cli

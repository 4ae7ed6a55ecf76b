#pragma once
// `sgm preview`.

#include "tools/support/console.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// Shows a window until the user closes it. Uses the options for a single picture.
Exit showPreview(const RenderOptions& options);

}  // namespace sgm::cli

#pragma once
// `sgm preview`.

#include "tools/support/console.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// A window, until its user closes it. Of the options, those of one picture count.
Exit showPreview(const RenderOptions& options);

}  // namespace sgm::cli

#pragma once
// `sgm render --plan` and `--section`: a survey of a region instead of a picture.

#include "tools/support/console.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// Contract: options.plan or options.section. Needs no device.
Exit drawSurvey(const RenderOptions& options);

}  // namespace sgm::cli

#pragma once
// `sgm render --plan` and `--section`: draws a survey (plan or section) of a region instead of a picture.

#include "tools/support/console.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// Draws the survey and writes it to a file. Needs no GPU. Contract: options.plan or options.section is set.
Exit drawSurvey(const RenderOptions& options);

}  // namespace sgm::cli

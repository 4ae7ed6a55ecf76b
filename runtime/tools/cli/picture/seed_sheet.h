#pragma once
// `sgm render --seeds A..B --sheet`: a contact sheet with a picture of the same grammar for each seed.

#include "tools/support/console.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// Draws the contact sheet. The sheet has about the size that --size gives. Its pictures have the same aspect ratio as
/// the sheet, in about as many columns as rows. If a seed fails, an error message takes the place of its picture; the
/// function then returns the exit status of the first failed seed. If all seeds fail, no file is written. Contract:
/// options.seeds is valid for readSeeds().
Exit drawSeeds(const RenderOptions& options);

}  // namespace sgm::cli

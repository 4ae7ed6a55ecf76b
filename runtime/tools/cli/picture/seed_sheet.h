#pragma once
// `sgm render --seeds A..B --sheet`: pictures of one world for each seed, side by side.

#include "tools/support/console.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// Draws the contact sheet. It has about the size of --size, its pictures have the same aspect ratio as --size, and
/// there are about as many columns as rows. If a seed fails, its place shows the error; the returned status is that of
/// the first failed seed. If all seeds fail, no file is written. Contract: options.seeds is valid for readSeeds().
Exit drawSeeds(const RenderOptions& options);

}  // namespace sgm::cli

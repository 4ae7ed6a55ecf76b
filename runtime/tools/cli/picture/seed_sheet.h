#pragma once
// `sgm render --seeds A..B --sheet`: one world for each seed, side by side.

#include "tools/support/console.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// The sheet has about the size of --size, its pictures have the same aspect ratio, and there are about as many columns
/// as rows. A failed seed's place shows the error, and the status is that of the first failed seed. If all fail, no
/// file is written. Contract: options.seeds is as for readSeeds.
Exit drawSeeds(const RenderOptions& options);

}  // namespace sgm::cli

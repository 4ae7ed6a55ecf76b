#pragma once
// `sgm render --seeds A..B --sheet`: one world a seed, side by side.

#include "tools/support/console.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

/// The sheet is about as large as --size asks, its pictures have the same shape, and there are about as many columns as
/// rows. A seed that fails has its reason in its place; the status is that of the first such seed. Where all fail, no
/// file is written. Contract: options.seeds is as readSeeds takes it.
Exit drawSeeds(const RenderOptions& options);

}  // namespace sgm::cli

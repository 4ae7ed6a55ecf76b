#pragma once
// The options of `sgm bench chunks`.

#include <cstdint>

#include "tools/support/console.h"
#include "tools/support/options.h"

namespace sgm::cli {

struct BenchChunksOptions : WorldOptions {
  uint64_t runs = 5;
};
Exit benchChunks(const BenchChunksOptions& options);

}  // namespace sgm::cli

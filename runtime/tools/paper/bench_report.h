#pragma once
// The output of `sgm bench paper`: our measured values, the values printed in the paper, and the paper's
// contradictions.

#include <span>

#include "base/json.h"
#include "tools/paper/commands.h"
#include "tools/paper/stage.h"

namespace sgm::cli {

/// results: one for each stage, in the order of kPaperStages. The first row of each result is the sequential backend,
/// which must be measured.
Json toJson(const BenchOptions& options, std::span<const StageResult> results);
void print(const BenchOptions& options, std::span<const StageResult> results);

}  // namespace sgm::cli

#pragma once
// The output of `sgm bench paper`: our figures, the paper's, and the paper's contradictions.

#include <span>

#include "base/json.h"
#include "tools/paper/commands.h"
#include "tools/paper/stage.h"

namespace sgm::cli {

/// results: one for each stage, in the order of kPaperStages; the first row is sequential and measured.
Json toJson(const BenchOptions& options, std::span<const StageResult> results);
void print(const BenchOptions& options, std::span<const StageResult> results);

}  // namespace sgm::cli

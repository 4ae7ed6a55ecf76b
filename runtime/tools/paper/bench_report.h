#pragma once
// What `sgm bench paper` says: our figures, those that the paper prints, and what is wrong with the latter.

#include <span>

#include "base/json.h"
#include "tools/paper/commands.h"
#include "tools/paper/stage.h"

namespace sgm::cli {

/// results: one a stage, in the order of kPaperStages; the first row is the sequential one, and measured.
Json toJson(const BenchOptions& options, std::span<const StageResult> results);
void print(const BenchOptions& options, std::span<const StageResult> results);

}  // namespace sgm::cli

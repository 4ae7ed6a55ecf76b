#pragma once
// Evaluates and prints a grammar's own `report` and `expect` statements.

#include "backend/backend.h"
#include "base/json.h"
#include "grammar/compile.h"
#include "tools/support/console.h"
#include "tools/support/options.h"

namespace sgm::cli {

/// The results of a grammar's `report` and `expect` statements for all seeds.
struct ExpectationSummary {
  Exit status = Exit::done;         ///< Exit::input if an expectation fails or a statement cannot be evaluated
  uint64_t expectations = 0;        ///< number of `expect` statements in the file
  uint64_t failed = 0;              ///< number of failed statements, summed over all seeds
  std::vector<uint64_t> bad_seeds;  ///< seeds with a failure, ascending
  Json statements;  ///< all results for --json: an array in the order of seeds, then of the statements in the file
};

/// Evaluates the `report` and `expect` statements of a compiled grammar. Unless options.json is set, prints reports and
/// fulfilled expectations to standard output, and failures to stderr as diagnostics. Warnings about elements that
/// derivation left out, and a progress bar, also go to stderr.
ExpectationSummary sayExpectations(const CompileResult& compiled, const WorldOptions& options, uint64_t seeds,
                                   Backend& backend, JobSystem& jobs);

}  // namespace sgm::cli

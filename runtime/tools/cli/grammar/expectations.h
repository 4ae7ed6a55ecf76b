#pragma once
// Evaluates and prints a grammar's own `report` and `expect` statements.

#include "backend/backend.h"
#include "base/json.h"
#include "grammar/compile.h"
#include "tools/support/console.h"
#include "tools/support/options.h"

namespace sgm::cli {

/// The results of a file's statements for all seeds.
struct ExpectationSummary {
  Exit status = Exit::done;         ///< input if an expectation fails or a statement cannot be evaluated
  uint64_t expectations = 0;        ///< in the file
  uint64_t failed = 0;              ///< of all statements and seeds
  std::vector<uint64_t> bad_seeds;  ///< seeds with a failure, ascending
  Json statements;                  ///< for --json: a list, by seed, then in the order of the file
};

/// Evaluates the statements of a compiled file. Unless options.json, prints reports and successes to standard output,
/// and failures to stderr as diagnostics. Warnings of omissions, and a progress bar, go to stderr too.
ExpectationSummary sayExpectations(const CompileResult& compiled, const WorldOptions& options, uint64_t seeds,
                                   Backend& backend, JobSystem& jobs);

}  // namespace sgm::cli

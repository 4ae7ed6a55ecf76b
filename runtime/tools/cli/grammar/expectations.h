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
  Exit status = Exit::done;         ///< Exit::input if an expectation fails or a statement cannot be evaluated
  uint64_t expectations = 0;        ///< number of `expect` statements in the file
  uint64_t failed = 0;              ///< number of failures over all statements and seeds
  std::vector<uint64_t> bad_seeds;  ///< seeds with a failure, ascending
  Json statements;                  ///< for --json: a list, ordered by seed, then as in the file
};

/// Evaluates the `report` and `expect` statements of a compiled file. Unless options.json is set, prints reports and
/// successes to standard output, and failures to stderr as diagnostics. Warnings about elements that derivation left
/// out, and a progress bar, also go to stderr.
ExpectationSummary sayExpectations(const CompileResult& compiled, const WorldOptions& options, uint64_t seeds,
                                   Backend& backend, JobSystem& jobs);

}  // namespace sgm::cli

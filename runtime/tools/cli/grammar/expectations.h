#pragma once
// A grammar's own `report` and `expect`, evaluated and said.

#include "backend/backend.h"
#include "base/json.h"
#include "grammar/compile.h"
#include "tools/support/console.h"
#include "tools/support/options.h"

namespace sgm::cli {

/// What became of a file's statements over all seeds.
struct ExpectationSummary {
  Exit status = Exit::done;         ///< input where an expectation fails or a statement cannot be evaluated
  uint64_t expectations = 0;        ///< in the file
  uint64_t failed = 0;              ///< of all statements with all seeds
  std::vector<uint64_t> bad_seeds;  ///< those with which something fails, ascending
  Json statements;                  ///< for --json: a list, by seed, then in the order of the file
};

/// Evaluates the statements of a compiled file. Unless options.json: reports and what holds go to standard output, what
/// fails goes to stderr like any other diagnostic. Warnings of what was left out, and a progress bar, go to stderr too.
ExpectationSummary sayExpectations(const CompileResult& compiled, const WorldOptions& options, uint64_t seeds,
                                   Backend& backend, JobSystem& jobs);

}  // namespace sgm::cli

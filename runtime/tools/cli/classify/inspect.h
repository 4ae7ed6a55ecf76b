#pragma once
// The parts of `sgm inspect`, the sandboxed process in which the metrics service examines uploads.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/result.h"
#include "tools/classify/base.h"
#include "tools/cli/classify/commands.h"
#include "tools/support/region.h"

namespace sgm::cli {

/// Why there is no report: the body of an HTTP answer (RFC 9457).
struct InspectProblem {
  int status = 422;
  std::string code = "bad_input";
  std::string detail;               ///< one sentence for users
  std::string pointer;              ///< to the wrong JSON value; empty: none
  int line = 0, column = 0;         ///< in a text, from 1; 0: none
  std::optional<Json> diagnostics;  ///< of a grammar, an array
};
Json toJson(const InspectProblem& problem);

/// For errors of an upload: a limit of the process is the service's problem (500), any other the upload's (422).
InspectProblem problemOf(const Error& error, const InspectOptions& options);
InspectProblem outOfMemory(const InspectOptions& options);

/// The process's answer: the members of a report, or a problem.
struct InspectAnswer {
  Json json;
  std::string preview;
};

/// Inspects a mesh or grammar from standard input. Throws only std::bad_alloc.
InspectAnswer inspectUpload(std::span<const std::byte> bytes, const InspectOptions& options,
                            const Result<masters::OpenedBase>& base);

/// A grammar's mesh, and the results for it.
struct InspectedGrammar {
  std::optional<Region> region;
  Json measures;           ///< the region's own part of `sgm measure --json`
  Json diagnostics;        ///< warnings, in the form of InspectProblem
  InspectProblem problem;  ///< set if there is no region
};
/// The grammar may import only the standard library, and no file is read.
InspectedGrammar meshUploadedGrammar(std::span<const std::byte> text, const InspectOptions& options);

/// Implements GET and PUT /api/v1/masters: the reference histograms, or a problem.
Json listedMasters(const InspectOptions& options);
Json storedMasters(std::span<const std::byte> json, const InspectOptions& options);

/// The base of that name, or the built-in reference histograms without a name or if the file does not exist.
Result<masters::OpenedBase> inspectedBase(const std::string& file);

}  // namespace sgm::cli

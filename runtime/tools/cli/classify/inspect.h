#pragma once
// The parts of `sgm inspect`: what the metrics service lets a process of its own find out of what came from outside.

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

/// Why there is no report: what an HTTP answer says of it (RFC 9457).
struct InspectProblem {
  int status = 422;
  std::string code = "bad_input";
  std::string detail;               ///< one sentence for people
  std::string pointer;              ///< into JSON that is wrong; empty: no place in one
  int line = 0, column = 0;         ///< of a text; from 1, 0: no place in one
  std::optional<Json> diagnostics;  ///< of a grammar, an array
};
Json toJson(const InspectProblem& problem);

/// Of what an upload holds: a limit of the process is the service's (500), what else is wrong is the upload's (422).
InspectProblem problemOf(const Error& error, const InspectOptions& options);
InspectProblem outOfMemory(const InspectOptions& options);

/// What goes out: a report's members, or a problem.
struct InspectAnswer {
  Json json;
  std::string preview;
};

/// The file on standard input: a mesh, or a grammar. Never throws but for want of memory.
InspectAnswer inspectUpload(std::span<const std::byte> bytes, const InspectOptions& options,
                            const Result<masters::OpenedBase>& base);

/// A grammar's mesh, and what is to be said of it.
struct InspectedGrammar {
  std::optional<Region> region;
  Json measures;           ///< what `sgm measure --json` says of the region by itself
  Json diagnostics;        ///< warnings, as InspectProblem has them
  InspectProblem problem;  ///< where there is no region
};
/// The text comes alone: whatever it imports, but for the standard library, is refused, and nothing is read.
InspectedGrammar meshUploadedGrammar(std::span<const std::byte> text, const InspectOptions& options);

/// What stands behind GET and PUT /api/v1/masters: the masters, or a problem.
Json listedMasters(const InspectOptions& options);
Json storedMasters(std::span<const std::byte> json, const InspectOptions& options);

/// The base that is named, or the masters that are built in where none is named, or where that is not there yet.
Result<masters::OpenedBase> inspectedBase(const std::string& file);

}  // namespace sgm::cli

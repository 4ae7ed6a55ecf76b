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

/// The reason why an upload has no report, as the body of an HTTP answer (RFC 9457).
struct InspectProblem {
  int status = 422;
  std::string code = "bad_input";
  std::string detail;               ///< explanation for users, one sentence
  std::string pointer;              ///< JSON pointer to the wrong value in the upload; empty: none
  int line = 0, column = 0;         ///< position of the error in an uploaded text, counted from 1; 0: none
  std::optional<Json> diagnostics;  ///< the compiler's messages about a grammar, as an array
};
Json toJson(const InspectProblem& problem);

/// Converts an error to a problem: HTTP status 422 if the upload is the cause (bad_input, invalid_argument, range,
/// limit), otherwise 500.
InspectProblem problemOf(const Error& error, const InspectOptions& options);
InspectProblem outOfMemory(const InspectOptions& options);

/// Output of the process: a report (or an InspectProblem) as JSON, and a preview mesh as bytes.
struct InspectAnswer {
  Json json;
  std::string preview;
};

/// Inspects an uploaded mesh or grammar. Throws only std::bad_alloc.
InspectAnswer inspectUpload(std::span<const std::byte> bytes, const InspectOptions& options,
                            const Result<masters::OpenedBase>& base);

/// The mesh of an uploaded grammar, and the results that only a grammar has.
struct InspectedGrammar {
  std::optional<Region> region;
  Json measures;           ///< the members of `sgm measure --json` that concern the region
  Json diagnostics;        ///< warnings of the compiler, as in InspectProblem::diagnostics
  InspectProblem problem;  ///< why the grammar cannot be meshed; set if `region` is empty
};
/// Compiles and meshes an uploaded grammar, which may import only the standard library; no other file is read.
InspectedGrammar meshUploadedGrammar(std::span<const std::byte> text, const InspectOptions& options);

/// The bodies of the HTTP answers to GET and PUT /api/v1/masters: the reference histograms, or a problem.
Json listedMasters(const InspectOptions& options);
Json storedMasters(std::span<const std::byte> json, const InspectOptions& options);

/// The reference histograms of the database `file`; the built-in ones if `file` is empty or does not exist.
Result<masters::OpenedBase> inspectedBase(const std::string& file);

}  // namespace sgm::cli

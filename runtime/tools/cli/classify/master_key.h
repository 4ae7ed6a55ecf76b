#pragma once
// Text for keys of reference histograms, and the database that an option names.

#include <string>

#include "base/json.h"
#include "tools/classify/base.h"

namespace sgm::cli {

/// The key as text: "mode corrected, 33 bins, 2 cells per metre".
std::string textOf(const measure::MasterKey& key);
Json toJson(const measure::MasterKey& key);

/// The reference histograms of a file; if `file` is empty, those of the default database or the built-in ones. Prints
/// to stderr how a damaged database was replaced. Errors: those of openBase; bad_input for a file that is not a
/// database of reference histograms.
Result<masters::OpenedBase> mastersOf(const std::string& file);

}  // namespace sgm::cli

#pragma once
// Output and choice of the reference histograms.

#include <string>

#include "base/json.h"
#include "tools/classify/base.h"

namespace sgm::cli {

/// "mode corrected, 33 bins, 2 cells per metre".
std::string textOf(const measure::MasterKey& key);
Json toJson(const measure::MasterKey& key);

/// The base of that name; without a name the default base, or the built-in reference histograms. Reports on stderr what
/// became of a damaged one. Errors: those of openBase; bad_input for a file that is not a base.
Result<masters::OpenedBase> mastersOf(const std::string& file);

}  // namespace sgm::cli

#pragma once
// What the command says of masters, and where it takes them from.

#include <string>

#include "base/json.h"
#include "tools/classify/base.h"

namespace sgm::cli {

/// "mode corrected, 33 bins, 2 cells per metre".
std::string textOf(const measure::MasterKey& key);
Json toJson(const measure::MasterKey& key);

/// The base of that name; without one that at its own place, or the masters that are built in. What became of a damaged
/// one goes to stderr. Errors: those of openBase; bad_input for a file that is no base.
Result<masters::OpenedBase> mastersOf(const std::string& file);

}  // namespace sgm::cli

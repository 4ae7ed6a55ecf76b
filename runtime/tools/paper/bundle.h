#pragma once
// The grammars that measure the paper, and their imported assets. They are embedded at configuration, since the command
// may run far from its sources.

#include <span>
#include <string_view>

#include "grammar/compile.h"

namespace sgm::cli {

struct BundledFile {
  std::string_view path;  ///< as in samples/grammars or tests/bench/grammars
  std::string_view bytes;
};
std::span<const BundledFile> bundledFiles();

/// Null if there is no such file.
const BundledFile* bundled(std::string_view path);

/// Imports come from the file's folder in the bundle. Contract: the file is in the bundle.
CompileResult compileBundled(std::string_view path);

}  // namespace sgm::cli

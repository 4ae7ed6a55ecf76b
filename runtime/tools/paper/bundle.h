#pragma once
// The grammars that the paper is measured by, and the assets that they import: put into the command when it was
// configured, for it may be far from its source.

#include <span>
#include <string_view>

#include "grammar/compile.h"

namespace sgm::cli {

struct BundledFile {
  std::string_view path;  ///< as in samples/grammars or tests/bench/grammars
  std::string_view bytes;
};
std::span<const BundledFile> bundledFiles();

/// Null where there is no such file.
const BundledFile* bundled(std::string_view path);

/// Imports come from the bundle, beside the file. Contract: it is bundled.
CompileResult compileBundled(std::string_view path);

}  // namespace sgm::cli

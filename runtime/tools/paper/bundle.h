#pragma once
// The grammars with which the paper is measured, and their imported assets. CMake embeds them in the program, since the
// command may run on a machine without the sources.

#include <span>
#include <string_view>

#include "grammar/compile.h"

namespace sgm::cli {

struct BundledFile {
  std::string_view path;  ///< path relative to samples/grammars or tests/bench/grammars
  std::string_view bytes;
};
std::span<const BundledFile> bundledFiles();

/// The embedded file with this path; null if there is none.
const BundledFile* bundled(std::string_view path);

/// Compiles an embedded grammar; its imports are searched in its folder within the bundle. Contract: the file is
/// embedded.
CompileResult compileBundled(std::string_view path);

}  // namespace sgm::cli

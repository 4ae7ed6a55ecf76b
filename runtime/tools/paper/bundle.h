#pragma once
// The grammars that the report measures, and the assets that they import. CMake embeds them in the program, since the
// program may run on a machine without the sources.

#include <span>
#include <string_view>

#include "grammar/compile.h"

namespace sgm::cli {

struct BundledFile {
  std::string_view path;  ///< path in the bundle, such as "cave.sgm" or "table4/cui.sgm"
  std::string_view bytes;
};
std::span<const BundledFile> bundledFiles();

/// The embedded file with this path in the bundle; null if there is none.
const BundledFile* bundled(std::string_view path);

/// Compiles an embedded grammar. Its imports are resolved relative to its folder in the bundle. Contract: the file is
/// embedded.
CompileResult compileBundled(std::string_view path);

}  // namespace sgm::cli

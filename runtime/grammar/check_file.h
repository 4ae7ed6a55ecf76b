#pragma once
// Checks one file, which may be a world or a library.

#include <string_view>

#include "grammar/compile.h"

namespace sgm {

struct CheckResult {
  CompileResult compiled;
  /// The file is a library for import: it has rules, lets and fields, but no declaration that only a root may have. Its
  /// program has no layers.
  bool library = false;
};

/// Like compileGrammar(), but also accepts a library, which has no start.
CheckResult checkFile(std::string_view text, std::string_view path, const CompileOptions& options = {});

}  // namespace sgm

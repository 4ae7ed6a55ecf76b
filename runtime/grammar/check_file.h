#pragma once
// Checks one file, which may be a world or a library.

#include <string_view>

#include "grammar/compile.h"

namespace sgm {

struct CheckResult {
  CompileResult compiled;
  /// The file is a library for import: it declares rules, lets and fields, and nothing that only a root has. Its
  /// program has no layers.
  bool library = false;
};

/// Like compileGrammar, but a library without a start is valid by itself.
CheckResult checkFile(std::string_view text, std::string_view path, const CompileOptions& options = {});

}  // namespace sgm

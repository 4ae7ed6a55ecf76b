#pragma once
// Whether one file is right, be it a world or a library.

#include <string_view>

#include "grammar/compile.h"

namespace sgm {

struct CheckResult {
  CompileResult compiled;
  /// The file is for others to import: it declares rules, lets and fields, and nothing that only a root has. Its
  /// program has no layers then.
  bool library = false;
};

/// compileGrammar, but a library that has no start is right by itself.
CheckResult checkFile(std::string_view text, std::string_view path, const CompileOptions& options = {});

}  // namespace sgm

#pragma once
// Prints syntax as text.

#include <string>
#include <string_view>

#include "grammar/syntax/syntax.h"

namespace sgm {

/// Prints the canonical layout of a file, with its comments; parsing and printing that gives the same bytes. One
/// statement a line, two spaces of indent; a block is on one line only if it was written so and fits.
std::string printModule(const Program& program, const ModuleSyntax& syntax);

/// Prints one line that is equal for files of equal meaning: no comments, no superfluous parentheses, numbers by value.
/// It judges hashMeaning (identity/hash_meaning.h) in tests, and its hash is the identity of programs of version 0.2.
std::string printMeaning(const Program& program, const ModuleSyntax& syntax);

/// "watertight", "components", ...
std::string_view measureName(Measure measure);
/// The text after `report` or `expect`, without the semicolon: "components(air) == 1 in block(8)".
std::string printMeasure(const Program& program, const Expectation& expectation);

}  // namespace sgm

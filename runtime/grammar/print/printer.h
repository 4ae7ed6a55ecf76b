#pragma once
// Prints syntax trees as text.

#include <string>
#include <string_view>

#include "grammar/syntax/syntax.h"

namespace sgm {

/// Prints a file in canonical layout, with its comments: one statement a line, indented by two spaces. A block stays on
/// one line only if it was written so and fits. Parsing and printing the result again gives the same bytes.
std::string printModule(const Program& program, const ModuleSyntax& syntax);

/// Prints a file as one line that is equal for files of equal meaning: without comments and redundant parentheses,
/// numbers by value. Tests compare hashMeaning (identity/hash_meaning.h) with it; version 0.2 identified programs by
/// the hash of this line.
std::string printMeaning(const Program& program, const ModuleSyntax& syntax);

/// "watertight", "components", ...
std::string_view measureName(Measure measure);
/// The text after `report` or `expect`, without the semicolon: "components(air) == 1 in block(8)".
std::string printMeasure(const Program& program, const Expectation& expectation);

}  // namespace sgm

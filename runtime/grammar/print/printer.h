#pragma once
// Syntax back to text.

#include <string>
#include <string_view>

#include "grammar/syntax/syntax.h"

namespace sgm {

/// The canonical layout of a file, comments kept: printing what was parsed from it gives the same bytes again. One
/// statement a line, two blanks of indent, a block on one line only where it was written so and fits.
std::string printModule(const Program& program, const ModuleSyntax& syntax);

/// One line that is equal for files of equal meaning: no comments, no superfluous parentheses, numbers by value.
std::string printMeaning(const Program& program, const ModuleSyntax& syntax);

/// "watertight", "components", ...
std::string_view measureName(Measure measure);
/// What follows `report` or `expect`, without the semicolon: "components(air) == 1 in block(8)".
std::string printMeasure(const Program& program, const Expectation& expectation);

}  // namespace sgm

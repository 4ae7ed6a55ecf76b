#pragma once
// The identity of a program's meaning: names by their texts, literals by their bits, no layout, comments, superfluous
// parentheses or places.

#include <span>

#include "grammar/syntax/syntax.h"

namespace sgm {

/// Changes with every change of what is hashed, or how. Version 1 was a hash of printMeaning's text (former_hash.h).
inline constexpr uint64_t kMeaningVersion = 2;

/// A hash of one file, equal exactly for files of which printMeaning (print/printer.h) prints equal text. Precondition:
/// the file was parsed without errors, and the checker has not resolved its names yet.
uint64_t hashMeaning(const Program& program, const ModuleSyntax& syntax);

/// Program::hash: of all files of a program and its assets, under the same conditions.
uint64_t hashMeaning(const Program& program, std::span<const ModuleSyntax> files);

}  // namespace sgm

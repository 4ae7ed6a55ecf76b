#pragma once
// Computes the hash that identifies a program's meaning: names by their texts, number literals by their bits. Layout,
// comments, redundant parentheses and positions in the text do not affect it.

#include <span>

#include "grammar/syntax/syntax.h"

namespace sgm {

/// Increment it when the hashed data or the hash function changes. Version 1 hashed printMeaning's text
/// (former_hash.h).
inline constexpr uint64_t kMeaningVersion = 2;

/// Hashes one file. Two files have equal hashes if and only if printMeaning (print/printer.h) prints equal texts for
/// them. Precondition: the file was parsed without errors, and its names are not resolved by the checker yet.
uint64_t hashMeaning(const Program& program, const ModuleSyntax& syntax);

/// Computes Program::hash, which covers all files and assets of a program. Precondition: as for the hash of one file.
uint64_t hashMeaning(const Program& program, std::span<const ModuleSyntax> files);

}  // namespace sgm

#pragma once
// The words of the language. Words of arguments (period, jitter, up ...) and of clauses (reach, uses, of ...) are
// ordinary names elsewhere; only the keywords below are reserved.

#include <span>
#include <string_view>

namespace sgm {

/// Reserved words, sorted.
std::span<const std::string_view> keywordTable();
/// Words with a meaning only where a clause expects them, sorted.
std::span<const std::string_view> clauseWordTable();
/// Words reserved for constructs that this version does not have (portal ...), sorted.
std::span<const std::string_view> unavailableTable();

/// Words that start a declaration.
std::span<const std::string_view> declarationTable();
/// Words of the transforms, in the order of XformKind.
std::span<const std::string_view> transformTable();
/// Words of the measures, in the order of Measure.
std::span<const std::string_view> measureTable();
/// Words of the parts of a box, in the order of BoxPart.
std::span<const std::string_view> boxPartTable();

/// The word of this language for another language's: `at` for `translate`; empty if it is unknown.
std::string_view wordFor(std::string_view foreign);

/// cell, scope, p, q and u: values that are always available.
bool isValueWord(std::string_view word);
bool isKeyword(std::string_view word);
bool startsDeclaration(std::string_view word);
bool isUnavailable(std::string_view word);

}  // namespace sgm

#pragma once
// The words of the language. Only keywords are reserved. Argument names (period, jitter, up ...) and clause words
// (reach, uses, of ...) may be used as names elsewhere.

#include <span>
#include <string_view>

namespace sgm {

/// Returns the reserved words, sorted.
std::span<const std::string_view> keywordTable();
/// Returns the words that have a meaning only where a clause expects them, sorted.
std::span<const std::string_view> clauseWordTable();
/// Returns the words reserved for future constructs (portal ...), sorted.
std::span<const std::string_view> unavailableTable();

/// Returns the words that start a declaration.
std::span<const std::string_view> declarationTable();
/// Returns the keywords of the transforms, in the order of XformKind.
std::span<const std::string_view> transformTable();
/// Returns the keywords of the measures, in the order of Measure.
std::span<const std::string_view> measureTable();
/// Returns the keywords of the parts of a box, in the order of BoxPart.
std::span<const std::string_view> boxPartTable();

/// Returns this language's word for a word of another language, such as `at` for `translate`; empty if it is unknown.
std::string_view wordFor(std::string_view foreign);

/// Whether the word is cell, scope, p, q or u, the built-in values.
bool isValueWord(std::string_view word);
bool isKeyword(std::string_view word);
bool startsDeclaration(std::string_view word);
bool isUnavailable(std::string_view word);

}  // namespace sgm

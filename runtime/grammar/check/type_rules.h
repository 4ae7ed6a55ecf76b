#pragma once
// Type rules that need no symbol table: agreement of types, and texts for messages about them.

#include <string>
#include <string_view>

#include "grammar/syntax/program.h"

namespace sgm {

constexpr Type numberType(Dim dim, bool sample = false) { return {ValueKind::number, dim, sample, false}; }

/// Whether a value of this type may be used where `kind` and `dim` are required. Always true for an unknown type, since
/// it results from an error that is already reported.
bool agrees(const Type& type, ValueKind kind, Dim dim);

/// The common type of two values. good: false if the types do not agree; then there is no common type.
struct Unified {
  Type type;
  bool good = true;
};
Unified unify(const Type& a, const Type& b);

/// Returns the innermost subexpression that is known only at sample time, for messages.
ExprId sampledPart(const Program& program, ExprId id);

/// Returns a hint how to give a number the required dimension; empty if no hint is known.
std::string unitHint(const Program& program, ExprId id, const Type& type, Dim wanted);
/// Returns an example of a value of this type, for messages: "2m".
std::string_view exampleOf(const Type& type);
/// Returns `hint`, or `other` if `hint` is empty.
std::string orElse(std::string_view hint, std::string_view other);

}  // namespace sgm

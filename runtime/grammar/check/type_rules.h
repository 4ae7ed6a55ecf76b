#pragma once
// Rules about types that need no names: agreement, hints, and the texts of messages about them.

#include <string>
#include <string_view>

#include "grammar/syntax/program.h"

namespace sgm {

constexpr Type numberType(Dim dim, bool sample = false) { return {ValueKind::number, dim, sample, false}; }

/// Whether a value may be used where this kind and dimension is required. An unknown type, which follows an error,
/// agrees with everything.
bool agrees(const Type& type, ValueKind kind, Dim dim);

/// A type for both of two values; good: they agree.
struct Unified {
  Type type;
  bool good = true;
};
Unified unify(const Type& a, const Type& b);

/// The innermost part of an expression that makes it a sample-time one.
ExprId sampledPart(const Program& program, ExprId id);

/// A change that gives a number the required dimension; empty if there is none.
std::string unitHint(const Program& program, ExprId id, const Type& type, Dim wanted);
/// An example of a value of this kind and dimension.
std::string_view exampleOf(const Type& type);
/// The hint, or the other if it is empty.
std::string orElse(std::string_view hint, std::string_view other);

}  // namespace sgm

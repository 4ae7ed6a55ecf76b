#pragma once
// Matches the arguments of a call, by position or by name, with the parameters of the function, rule or shape called.

#include <initializer_list>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "grammar/check/symbols.h"

namespace sgm {

/// A parameter of a rule, a let, a field, a built-in function or a primitive.
struct FormalView {
  std::string_view name;
  ExprId fallback = kNoId;  ///< the default value, bound if the argument is omitted; kNoId: no default
  bool required = true;
  bool named_only = false;
};

std::vector<FormalView> viewOf(const Program& program, IdRange formals);
std::vector<FormalView> viewOf(std::span<const BuiltinParam> params);
/// Returns the types of formals before any argument is checked: a formal with a declared range has the range's
/// dimension; all others are unknown.
std::vector<Type> typesOf(const Program& program, IdRange formals);

struct Callee {
  std::string_view name;
  std::vector<FormalView> formals;
  /// the callee accepts extra positional arguments after its formals, such as the corners of a prism
  bool variadic = false;
};

/// Returns one expression for each formal, in order, followed by the variadic arguments. kNoId marks an omitted
/// argument whose formal has no default. Returns nullopt after reporting an error.
std::optional<std::vector<uint32_t>> bindArguments(CheckContext& check, const Symbols& symbols, const Scope& scope,
                                                   ExprId call, const Callee& callee);

/// Binds the arguments of a transform or a scatter area, by position or by name. out: array with one element for each
/// of `words`, the parameters' names; omitted arguments become kNoId. required: the minimum number of arguments. span:
/// of the statement, for messages. Returns false after reporting an error.
bool bindWords(CheckContext& check, IdRange args, const Span& span, std::string_view callee,
               std::initializer_list<std::string_view> words, size_t required, ExprId* out);

}  // namespace sgm

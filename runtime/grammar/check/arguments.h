#pragma once
// Joins the arguments of a call, by position and by name, with the parameters of its callee.

#include <initializer_list>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "grammar/check/symbols.h"

namespace sgm {

/// A parameter of a callee.
struct FormalView {
  std::string_view name;
  ExprId fallback = kNoId;  ///< bound if the argument is omitted
  bool required = true;
  bool named_only = false;
};

std::vector<FormalView> viewOf(const Program& program, IdRange formals);
std::vector<FormalView> viewOf(std::span<const BuiltinParam> params);
/// The types of formals before arguments are known: the dimension of those with a range.
std::vector<Type> typesOf(const Program& program, IdRange formals);

struct Callee {
  std::string_view name;
  std::vector<FormalView> formals;
  bool variadic = false;  ///< takes further arguments after its formals, and none by name
};

/// Returns an expression for each formal, in order, then the variadic ones; kNoId: omitted, without a fallback. Returns
/// nullopt after an error.
std::optional<std::vector<uint32_t>> bindArguments(CheckContext& check, const Symbols& symbols, const Scope& scope,
                                                   ExprId call, const Callee& callee);

/// Binds the written arguments of a transform or an area, by position or by name, to the expressions at `out`, one for
/// each word; those that are omitted become kNoId. required: the least number of arguments. span: of the statement.
/// Returns false after an error.
bool bindWords(CheckContext& check, IdRange args, const Span& span, std::string_view callee,
               std::initializer_list<std::string_view> words, size_t required, ExprId* out);

}  // namespace sgm

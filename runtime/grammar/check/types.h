#pragma once
// Infers and checks the types of expressions.
//
// expressions.cpp: operators and names. members.cpp: members of values. calls.cpp: functions, methods and primitives.
// lets.cpp: lets and fields, checked once per distinct tuple of argument types, so that one `fbm` works for
// lengths and for ratios. requirements.cpp: checks that an expression has a required type or value.

#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "grammar/check/constants.h"
#include "grammar/check/symbols.h"

namespace sgm {

/// Checks expressions in the current scope. Caches the result types of lets and fields by the types of their arguments.
class Types {
 public:
  Types(CheckContext& check, Symbols& symbols) : check_(check), symbols_(symbols), constants_(check.program) {}

  /// Starts a new rule, override or top-level expression: replaces all locals by those of `scope`.
  void enter(Scope scope);
  Scope& scope() { return scope_; }
  /// Adds a local to the scope; reports an error at `span`, the declaration, if the name is already taken.
  void declareLocal(NameId name, const Span& span, const Local& local);

  /// Resolves the names of an expression, stores its type in the tree and returns it. Returns kUnknownType after
  /// reporting an error, and for kNoId.
  Type checkExpression(ExprId id);
  std::vector<Type> checkExpressions(const std::vector<uint32_t>& ids);
  /// Checks the arguments of a call that cannot be matched with parameters, because the callee is unknown.
  void checkLooseArguments(const ExprNode& call);
  /// Checks the arguments of a call of a primitive.
  void checkPrimitive(ExprId id);
  /// Checks the lets and fields that no checked expression uses.
  void checkUnused();

  /// Checks an expression and requires a kind, a dimension and, unless `sample` is true, a value that is known at
  /// derivation time. what: subject of the message, such as "the radius of ...".
  Type require(ExprId id, ValueKind kind, Dim dim, std::string_view what, bool sample = false);
  /// Like require() for an expression whose type is known. Avoids checking an expression twice, so that time stays
  /// linear in the depth of nesting.
  void requireType(ExprId id, const Type& type, ValueKind kind, Dim dim, std::string_view what, bool sample = false);
  /// Like require() for a number that, if it is constant, must also lie in a range.
  void requireRange(ExprId id, Dim dim, std::string_view what, const ValueRange& range);
  /// Requires that arguments have the dimension of their parameter's declared range. Sets a wrong argument's type in
  /// `types` to the declared one, so that the same error is not reported again in the callee.
  void requireFormalRanges(IdRange formals, std::span<const uint32_t> bound, std::span<Type> types,
                           std::string_view callee);
  /// Requires that the value of a checked expression is known at derivation time. what: subject of the error message.
  void requireDerived(ExprId id, std::string_view what);
  /// Reports an error if a checked expression is constant and its value lies outside of the range.
  void judgeRange(ExprId id, const ValueRange& range);
  /// Returns the value of a checked expression if it is constant.
  std::optional<double> fold(ExprId id) { return constants_.fold(id); }

  /// Resolves the layer of a probe or a query and records the use in Scope::asked. Returns the layer's index; kNoId
  /// after reporting an error. verb: see AskedLayer.
  uint32_t askLayer(NameId name, const Span& span, std::string_view verb);

 private:
  /// A let or field (its Ref and index) with the types of its arguments.
  using Key = std::tuple<Ref, uint32_t, std::vector<std::tuple<int, int, int, bool, bool>>>;

  Type checkVector(ExprId id);
  Type checkBinary(ExprId id);
  Type checkConditional(ExprId id);
  Type checkName(ExprId id);
  Type checkMember(ExprId id);
  Type checkQuery(ExprId id);
  Type checkCall(ExprId id);
  Type checkBuiltin(ExprId id);
  Type checkMethod(ExprId id);
  /// Checks arguments against the parameters of a built-in function, and checks each expression only once. Returns the
  /// common dimension of all arguments for `any_dim` parameters; nullopt if each of them is a literal 0.
  std::optional<Dim> checkArguments(const std::vector<uint32_t>& bound, std::span<const BuiltinParam> params,
                                    std::string_view callee);
  Type useValue(ExprId id, Ref ref, uint32_t index, const std::vector<Type>& args);
  Type useLocalField(ExprId id, const Local& local);
  bool canNestDeeper(ExprId id);

  CheckContext& check_;
  Symbols& symbols_;
  Constants constants_;
  Scope scope_;
  std::map<Key, Type> known_;                   ///< result types of lets and global fields
  std::map<Key, Type> known_local_;             ///< result types of local fields; cleared by enter()
  std::vector<std::pair<Ref, uint32_t>> open_;  ///< the lets and fields whose bodies are being checked, outermost first
  int depth_ = 0;                               ///< nesting depth of the expression that is being checked
};

}  // namespace sgm

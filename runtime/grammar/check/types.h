#pragma once
// The types of expressions.
//
// expressions.cpp: operators and names. members.cpp: parts of values. calls.cpp: functions, methods and primitives.
// lets.cpp: lets and fields, which are checked anew for each tuple of argument types, so that one `fbm` works for
// lengths and for ratios. requirements.cpp: requirements for a type or a value.

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

/// The scope of the expression that is being checked, and the types that lets and fields have in it: one for each tuple
/// of argument types with which they were used.
class Types {
 public:
  Types(CheckContext& check, Symbols& symbols) : check_(check), symbols_(symbols), constants_(check.program) {}

  /// Begins a rule, an override or an expression outside of these: ends all locals.
  void enter(Scope scope);
  Scope& scope() { return scope_; }
  /// Reports an error instead if the name is taken. span: of the declaration.
  void declareLocal(NameId name, const Span& span, const Local& local);

  /// Resolves the names of an expression, and stores its type in the tree. Returns kUnknownType after an error. Without
  /// an expression (kNoId) the type is unknown, too.
  Type checkExpression(ExprId id);
  std::vector<Type> checkExpressions(const std::vector<uint32_t>& ids);
  /// Checks the arguments of a call whose callee or parameters are unknown.
  void checkLooseArguments(const ExprNode& call);
  /// Checks the arguments of a call of a primitive.
  void checkPrimitive(ExprId id);
  /// Checks the lets and fields that nothing has used.
  void checkUnused();

  /// Like checkExpression(), but requires a kind, a dimension and, unless `sample` is set, a value known when shapes
  /// are derived. what: "the radius of ...".
  Type require(ExprId id, ValueKind kind, Dim dim, std::string_view what, bool sample = false);
  /// The same for an expression with a known type: no expression is checked twice, so that nesting stays cheap.
  void requireType(ExprId id, const Type& type, ValueKind kind, Dim dim, std::string_view what, bool sample = false);
  /// Like require() for a number; a constant must also lie in a range.
  void requireRange(ExprId id, Dim dim, std::string_view what, const ValueRange& range);
  /// Requires that arguments have the dimension of their formal's range; continues as if they had, so that one error is
  /// reported once.
  void requireFormalRanges(IdRange formals, std::span<const uint32_t> bound, std::span<Type> types,
                           std::string_view callee);
  /// Requires that a checked expression is known when shapes are derived.
  void requireDerived(ExprId id, std::string_view what);
  /// Reports a checked constant that lies outside of a range.
  void judgeRange(ExprId id, const ValueRange& range);
  /// The value of a checked expression if it is a constant.
  std::optional<double> fold(ExprId id) { return constants_.fold(id); }

  /// The layer of a probe or a query in the current rule or override; kNoId after an error. verb: as in AskedLayer.
  uint32_t askLayer(NameId name, const Span& span, std::string_view verb);

 private:
  /// A let or a field, and the types of its arguments.
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
  /// Checks arguments against a builtin's parameters, each expression once. Returns the common dimension of the
  /// parameters of any dimension; nullopt if all these arguments are a literal 0.
  std::optional<Dim> checkArguments(const std::vector<uint32_t>& bound, std::span<const BuiltinParam> params,
                                    std::string_view callee);
  Type useValue(ExprId id, Ref ref, uint32_t index, const std::vector<Type>& args);
  Type useLocalField(ExprId id, const Local& local);
  bool canNestDeeper(ExprId id);

  CheckContext& check_;
  Symbols& symbols_;
  Constants constants_;
  Scope scope_;
  std::map<Key, Type> known_;                   ///< results of lets and global fields
  std::map<Key, Type> known_local_;             ///< the same for local fields, since enter()
  std::vector<std::pair<Ref, uint32_t>> open_;  ///< the lets and fields around the expression
  int depth_ = 0;                               ///< of nested expressions
};

}  // namespace sgm

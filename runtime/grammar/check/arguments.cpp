#include "grammar/check/arguments.h"

#include <algorithm>

#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// Returns the signature of a callee for messages, such as "`rot(axis, angle)`".
std::string signatureOf(std::string_view callee, const std::vector<std::string_view>& names) {
  std::string out = join({"`", callee, "("});
  for (size_t i = 0; i < names.size(); ++i) out += join({i > 0 ? ", " : "", names[i]});
  return out + ")`";
}

std::string signatureOf(const Callee& callee) {
  std::vector<std::string_view> names;
  for (const FormalView& formal : callee.formals) names.push_back(formal.name);
  if (callee.variadic) names.push_back("...");
  return signatureOf(callee.name, names);
}

/// The parser reads the argument `salt -3` as a subtraction. If `salt` is a parameter of the callee and no other
/// visible name, the author probably meant the named argument `salt`: then returns `salt`, otherwise kNoId.
NameId meantByDifference(const CheckContext& check, const Symbols& symbols, const Scope& scope, const ArgNode& arg,
                         const std::vector<FormalView>& formals) {
  const ExprNode& value = check.node(arg.value);
  if (arg.name != kNoId || value.kind != ExprKind::binary || value.binary != BinaryOp::subtract) return kNoId;
  const ExprNode& left = check.node(check.child(value, 0));
  if (left.kind != ExprKind::name || symbols.find(scope.module, left.name) != nullptr) return kNoId;
  const bool formal =
      std::ranges::any_of(formals, [&](const FormalView& f) { return f.name == check.text(left.name); });
  return formal && !scope.hides(left.name) ? left.name : kNoId;
}

}  // namespace

std::vector<FormalView> viewOf(const Program& program, IdRange formals) {
  std::vector<FormalView> out;
  for (uint32_t i = 0; i < formals.count; ++i) {
    const FormalNode& formal = program.ast.formals[formals.first + i];
    out.push_back({program.text(formal.name), formal.fallback, formal.fallback == kNoId, false});
  }
  return out;
}

std::vector<FormalView> viewOf(std::span<const BuiltinParam> params) {
  std::vector<FormalView> out;
  for (const BuiltinParam& p : params) out.push_back({p.name, kNoId, p.required, p.named_only});
  return out;
}

std::vector<Type> typesOf(const Program& program, IdRange formals) {
  std::vector<Type> types(formals.count);
  for (uint32_t i = 0; i < formals.count; ++i) {
    const FormalNode& formal = program.ast.formals[formals.first + i];
    if (formal.ranged) types[i] = {ValueKind::number, formal.dim, false, false};
  }
  return types;
}

std::optional<std::vector<uint32_t>> bindArguments(CheckContext& check, const Symbols& symbols, const Scope& scope,
                                                   ExprId call, const Callee& callee) {
  const std::vector<FormalView>& formals = callee.formals;
  const ExprNode& n = check.node(call);
  std::vector<uint32_t> bound(formals.size(), kNoId);
  bool good = true, named = false;
  size_t position = 0;
  for (uint32_t i = 0; i < n.args.count; ++i) {
    ArgNode& arg = check.program.ast.args[n.args.first + i];
    if (const NameId name = meantByDifference(check, symbols, scope, arg, formals); name != kNoId) {
      check.sink.error(
          arg.span, codes::kArgumentName, join({"this is `", check.text(name), "` minus something"}),
          join({"to give `", check.text(name), "` a value below 0, write `", check.text(name), " = -...`"}));
      arg.value = check.child(check.node(arg.value), 1);
      named = true;
      good = false;
      continue;
    }
    if (arg.name != kNoId && callee.variadic) {
      check.sink.error(arg.span, codes::kArgumentName, join({"the arguments of `", callee.name, "` have no names"}),
                       join({"it is ", signatureOf(callee)}));
      return std::nullopt;
    }
    if (arg.name != kNoId) {
      named = true;
      Suggestion suggestion(check.text(arg.name));
      size_t index = formals.size();
      for (size_t f = 0; f < formals.size(); ++f) {
        if (formals[f].name == check.text(arg.name)) index = f;
        suggestion.offer(formals[f].name);
      }
      if (index == formals.size()) {
        const std::string hint = suggestion.hint();
        check.sink.error(arg.span, codes::kArgumentName,
                         join({"`", callee.name, "` has no parameter `", check.text(arg.name), "`"}),
                         hint.empty() ? join({"it is ", signatureOf(callee)}) : hint);
        good = false;
      } else if (bound[index] != kNoId) {
        check.sink.error(arg.span, codes::kArgumentName, join({"`", check.text(arg.name), "` is given twice"}),
                         join({"it is ", signatureOf(callee)}));
        good = false;
      } else {
        bound[index] = arg.value;
      }
      continue;
    }
    if (named) {
      check.sink.error(arg.span, codes::kArgumentName, "an argument without a name follows an argument with a name",
                       join({"it is ", signatureOf(callee)}));
      good = false;
      continue;
    }
    if (position < formals.size() && !formals[position].named_only) {
      bound[position++] = arg.value;
    } else if (callee.variadic) {
      bound.push_back(arg.value);
    } else if (position < formals.size()) {
      check.sink.error(arg.span, codes::kArgumentName, join({"this argument of `", callee.name, "` needs its name"}),
                       join({"write `", callee.name, "(", formals[position].name, " ...)`"}));
      return std::nullopt;
    } else {
      check.sink.error(
          arg.span, codes::kArgumentCount,
          join({"`", callee.name, "` takes ", std::to_string(formals.size()),
                formals.size() == 1 ? " argument, not " : " arguments, not ", std::to_string(n.args.count)}),
          formals.empty() ? "" : join({"it is ", signatureOf(callee)}));
      return std::nullopt;
    }
  }
  if (!good) return std::nullopt;
  for (size_t f = 0; f < formals.size(); ++f) {
    if (bound[f] != kNoId) continue;
    bound[f] = formals[f].fallback;
    if (!formals[f].required) continue;
    check.sink.error(n.span, codes::kArgumentCount, join({"`", callee.name, "` needs `", formals[f].name, "`"}),
                     join({"it is ", signatureOf(callee)}));
    return std::nullopt;
  }
  return bound;
}

bool bindWords(CheckContext& check, IdRange args, const Span& span, std::string_view callee,
               std::initializer_list<std::string_view> words, size_t required, ExprId* out) {
  const std::vector<std::string_view> list(words);
  const std::string hint = join({"it is ", signatureOf(callee, list)});
  size_t position = 0, filled = 0;
  for (size_t w = 0; w < list.size(); ++w) out[w] = kNoId;
  for (uint32_t i = 0; i < args.count; ++i) {
    const ArgNode& arg = check.program.ast.args[args.first + i];
    size_t index = position++;
    if (arg.name != kNoId) {
      index = static_cast<size_t>(std::find(list.begin(), list.end(), check.text(arg.name)) - list.begin());
      if (index == list.size()) {
        check.sink.error(arg.span, codes::kArgumentName,
                         join({"`", callee, "` has no parameter `", check.text(arg.name), "`"}), hint);
        return false;
      }
    }
    if (index < list.size() && out[index] != kNoId) {
      check.sink.error(arg.span, codes::kArgumentName, join({"`", list[index], "` of `", callee, "` is given twice"}),
                       hint);
      return false;
    }
    if (index >= list.size()) {
      check.sink.error(arg.span, codes::kArgumentCount,
                       join({"`", callee, "` takes at most ", std::to_string(list.size()),
                             list.size() == 1 ? " argument" : " arguments"}),
                       hint);
      return false;
    }
    out[index] = arg.value;
    ++filled;
  }
  if (filled >= required) return true;
  check.sink.error(
      span, codes::kArgumentCount,
      join({"`", callee, "` needs ", required == 1 ? "an argument" : std::to_string(required) + " arguments"}), hint);
  return false;
}

}  // namespace sgm

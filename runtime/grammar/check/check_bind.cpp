#include <algorithm>

#include "grammar/check/check.h"
#include "grammar/std/std_library.h"
#include "grammar/syntax/foreign_words.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// "`rot(axis, angle)`".
std::string signatureOf(std::string_view callee, const std::vector<std::string_view>& names) {
  std::string out = join({"`", callee, "("});
  for (size_t i = 0; i < names.size(); ++i) out += join({i > 0 ? ", " : "", names[i]});
  return out + ")`";
}

}  // namespace

std::vector<Checker::FormalView> Checker::viewOf(IdRange formals) const {
  std::vector<FormalView> out;
  for (uint32_t i = 0; i < formals.count; ++i) {
    const FormalNode& formal = program_.ast.formals[formals.first + i];
    out.push_back({text(formal.name), formal.fallback, formal.fallback == kNoId, false});
  }
  return out;
}

std::vector<Type> Checker::typesOf(IdRange formals) const {
  std::vector<Type> types(formals.count);
  for (uint32_t i = 0; i < formals.count; ++i) {
    const FormalNode& formal = program_.ast.formals[formals.first + i];
    if (formal.ranged) types[i] = {ValueKind::number, formal.dim, false, false};
  }
  return types;
}

void Checker::demandRanged(IdRange formals, std::span<const uint32_t> bound, std::span<Type> types,
                           std::string_view callee) {
  for (uint32_t i = 0; i < formals.count && i < bound.size(); ++i) {
    const FormalNode formal = program_.ast.formals[formals.first + i];
    if (!formal.ranged) continue;
    if (bound[i] != formal.fallback)
      demandType(bound[i], types[i], ValueKind::number, formal.dim,
                 join({"`", text(formal.name), "` of `", callee, "`"}), true);
    types[i] = {ValueKind::number, formal.dim, types[i].sample, false};
  }
}

std::vector<Checker::FormalView> Checker::viewOf(std::span<const BuiltinParam> params) const {
  std::vector<FormalView> out;
  for (const BuiltinParam& p : params) out.push_back({p.name, kNoId, p.required, p.named_only});
  return out;
}

/// For `salt -3`, which is parsed as a difference: `salt`, if that is only a parameter name of the callee.
NameId Checker::meantByDifference(const ArgNode& arg, const std::vector<FormalView>& formals) const {
  const ExprNode& value = node(arg.value);
  if (arg.name != kNoId || value.kind != ExprKind::binary || value.binary != BinaryOp::subtract) return kNoId;
  const ExprNode& left = node(child(value, 0));
  if (left.kind != ExprKind::name || symbols_[scope_.module].contains(left.name)) return kNoId;
  const bool formal = std::ranges::any_of(formals, [&](const FormalView& f) { return f.name == text(left.name); });
  const bool local = std::ranges::any_of(scope_.locals, [&](const Local& l) { return l.name == left.name; });
  return formal && !local ? left.name : kNoId;
}

bool Checker::bind(ExprId call, std::string_view callee, const std::vector<FormalView>& formals, bool variadic,
                   std::vector<uint32_t>& bound) {
  const ExprNode& n = node(call);
  bound.assign(formals.size(), kNoId);
  bool good = true, named = false;
  auto signature = [&] {
    std::vector<std::string_view> names;
    for (const FormalView& formal : formals) names.push_back(formal.name);
    if (variadic) names.push_back("...");
    return signatureOf(callee, names);
  };
  size_t position = 0;
  for (uint32_t i = 0; i < n.args.count; ++i) {
    ArgNode& arg = program_.ast.args[n.args.first + i];
    if (const NameId name = meantByDifference(arg, formals); name != kNoId) {
      sink_.error(arg.span, codes::kArgumentName, join({"this is `", text(name), "` minus something"}),
                  join({"to give `", text(name), "` a value below 0, write `", text(name), " = -...`"}));
      arg.value = child(node(arg.value), 1);
      named = true;
      good = false;
      continue;
    }
    if (arg.name != kNoId && variadic) {
      sink_.error(arg.span, codes::kArgumentName, join({"the arguments of `", callee, "` have no names"}),
                  join({"it is ", signature()}));
      return false;
    }
    if (arg.name != kNoId) {
      named = true;
      Suggestion suggestion(text(arg.name));
      size_t index = formals.size();
      for (size_t f = 0; f < formals.size(); ++f) {
        if (formals[f].name == text(arg.name)) index = f;
        suggestion.offer(formals[f].name);
      }
      if (index == formals.size()) {
        const std::string hint = suggestion.hint();
        sink_.error(arg.span, codes::kArgumentName, join({"`", callee, "` has no parameter `", text(arg.name), "`"}),
                    hint.empty() ? join({"it is ", signature()}) : hint);
        good = false;
      } else if (bound[index] != kNoId) {
        sink_.error(arg.span, codes::kArgumentName, join({"`", text(arg.name), "` is given twice"}),
                    join({"it is ", signature()}));
        good = false;
      } else {
        bound[index] = arg.value;
      }
      continue;
    }
    if (named) {
      sink_.error(arg.span, codes::kArgumentName, "an argument without a name follows an argument with a name",
                  join({"it is ", signature()}));
      good = false;
      continue;
    }
    if (position < formals.size() && !formals[position].named_only) {
      bound[position++] = arg.value;
    } else if (variadic) {
      bound.push_back(arg.value);
    } else if (position < formals.size()) {
      sink_.error(arg.span, codes::kArgumentName, join({"this argument of `", callee, "` needs its name"}),
                  join({"write `", callee, "(", formals[position].name, " ...)`"}));
      return false;
    } else {
      sink_.error(arg.span, codes::kArgumentCount,
                  join({"`", callee, "` takes ", std::to_string(formals.size()),
                        formals.size() == 1 ? " argument, not " : " arguments, not ", std::to_string(n.args.count)}),
                  formals.empty() ? "" : join({"it is ", signature()}));
      return false;
    }
  }
  if (!good) return false;
  for (size_t f = 0; f < formals.size(); ++f) {
    if (bound[f] != kNoId) continue;
    bound[f] = formals[f].fallback;
    if (!formals[f].required) continue;
    sink_.error(n.span, codes::kArgumentCount, join({"`", callee, "` needs `", formals[f].name, "`"}),
                join({"it is ", signature()}));
    return false;
  }
  return true;
}

bool Checker::bindWords(IdRange args, const Span& span, std::string_view callee,
                        std::initializer_list<std::string_view> words, size_t required, ExprId* out) {
  const std::vector<std::string_view> list(words);
  const std::string hint = join({"it is ", signatureOf(callee, list)});
  size_t position = 0, filled = 0;
  for (size_t w = 0; w < list.size(); ++w) out[w] = kNoId;
  for (uint32_t i = 0; i < args.count; ++i) {
    const ArgNode& arg = program_.ast.args[args.first + i];
    size_t index = position++;
    if (arg.name != kNoId) {
      index = static_cast<size_t>(std::find(list.begin(), list.end(), text(arg.name)) - list.begin());
      if (index == list.size()) {
        sink_.error(arg.span, codes::kArgumentName, join({"`", callee, "` has no parameter `", text(arg.name), "`"}),
                    hint);
        return false;
      }
    }
    if (index < list.size() && out[index] != kNoId) {
      sink_.error(arg.span, codes::kArgumentName, join({"`", list[index], "` of `", callee, "` is given twice"}), hint);
      return false;
    }
    if (index >= list.size()) {
      sink_.error(arg.span, codes::kArgumentCount,
                  join({"`", callee, "` takes at most ", std::to_string(list.size()),
                        list.size() == 1 ? " argument" : " arguments"}),
                  hint);
      return false;
    }
    out[index] = arg.value;
    ++filled;
  }
  if (filled >= required) return true;
  sink_.error(span, codes::kArgumentCount,
              join({"`", callee, "` needs ", required == 1 ? "an argument" : std::to_string(required) + " arguments"}),
              hint);
  return false;
}

void Checker::offerNames(Suggestion& suggestion, bool calls) const {
  for (const Local& local : scope_.locals) suggestion.offer(text(local.name));
  for (const auto& [name, symbol] : symbols_[scope_.module]) suggestion.offer(text(name));
  if (calls) {
    for (const BuiltinInfo& info : builtinTable())
      if (info.id != Builtin::cell_point && info.id != Builtin::cell_links) suggestion.offer(info.name);
    for (const PrimitiveInfo& info : primitiveTable()) suggestion.offer(info.name);
  } else {
    for (std::string_view word : {"cell", "scope"}) suggestion.offer(word);
  }
}

void Checker::unknownName(const Span& span, NameId name, bool call, bool shape) {
  if (mayBeLost(scope_.module, name)) return;
  const std::string_view word = text(name);
  Suggestion suggestion(word);
  offerNames(suggestion, call || shape);
  if (const std::string ours = hintFor(word); !ours.empty()) {
    sink_.error(span, codes::kUnknownName, join({"unknown name `", word, "`"}), ours);
    return;
  }
  sink_.error(span, codes::kUnknownName, join({"unknown name `", word, "`"}),
              suggestion.hintOr(shape  ? join({"add `rule ", word, " { ... }`"})
                                : call ? join({"add `let ", word, "(...) = ...;`"})
                                       : join({"add `let ", word, " = ...;`, or `param ", word, " = ...;`"})));
}

/// Reports an error if the receiver is a missing import, and returns whether it is.
bool Checker::notImported(const ExprNode& receiver, bool shape) {
  const std::string_view word = text(receiver.name);
  if (isValueWord(word)) return false;
  if (mayBeLost(scope_.module, receiver.name)) return true;
  const std::string path = join({"std/", word, ".sgm"});
  const bool standard = !standardModule(path).empty();
  if (!standard && !shape) return false;
  Suggestion suggestion(word);
  for (const auto& [name, symbol] : symbols_[scope_.module])
    if (symbol.import) suggestion.offer(text(name));
  sink_.error(
      receiver.span, codes::kUnknownName, join({"nothing is imported as `", word, "` here"}),
      suggestion.hintOr(join({"add `import \"", standard ? path : join({word, ".sgm"}), "\" as ", word, ";`"})));
  return true;
}

/// Sets ref, id and qualifier of a call or a name; removes a receiver that is a module.
bool Checker::resolveCallee(ExprId call, bool shape) {
  ExprNode& n = node(call);
  if (n.ref != Ref::none) return true;
  const std::map<NameId, Symbol>* table = &symbols_[scope_.module];
  uint32_t module_of_callee = scope_.module;
  bool qualified = false;
  if (n.children.count > 0) {
    const ExprNode& receiver = node(child(n, 0));
    if (receiver.kind != ExprKind::name) return false;
    const auto module = table->find(receiver.name);
    const bool hidden = std::any_of(scope_.locals.begin(), scope_.locals.end(),
                                    [&](const Local& local) { return local.name == receiver.name; });
    if (!hidden && module != table->end() && module->second.asset) {
      assetMisused(receiver.span, receiver.name);
      return true;
    }
    if (!hidden && module == table->end() && notImported(receiver, shape)) return true;
    if (hidden || module == table->end() || !module->second.import) return false;
    if (module->second.id == kNoId && mayBeLost(kNoId, n.name)) return true;  // a file that could not be read
    module_of_callee = module->second.id;
    table = &symbols_[module_of_callee];
    qualified = true;
  }
  const auto found = table->find(n.name);
  if (found != table->end() && found->second.asset) {
    assetMisused(n.span, n.name);
    return true;
  }
  if (found != table->end() && !found->second.import) {
    n.ref = found->second.ref;
    n.id = found->second.id;
    if (qualified) {
      n.qualifier = node(child(n, 0)).name;
      n.children = {};
    }
    return true;
  }
  Span span = n.span;
  if (qualified) {
    if (mayBeLost(module_of_callee, n.name)) return true;
    Suggestion suggestion(text(n.name));
    std::string all;
    for (const auto& [name, symbol] : *table) {
      if (symbol.import || symbol.asset) continue;
      suggestion.offer(text(name));
      all += join({all.empty() ? "it has " : ", ", text(name)});
    }
    sink_.error(span, codes::kUnknownName, join({"`", text(node(child(n, 0)).name), "` has no `", text(n.name), "`"}),
                suggestion.hintOr(all.empty() ? "it declares nothing" : all));
    return true;
  }
  if (const PrimitiveInfo* primitive = findPrimitive(text(n.name))) {
    n.ref = Ref::primitive;
    n.id = static_cast<uint32_t>(primitive->id);
    return true;
  }
  const BuiltinInfo* builtin = findBuiltin(text(n.name));
  if (builtin != nullptr && builtin->id != Builtin::cell_point && builtin->id != Builtin::cell_links) {
    n.ref = Ref::builtin;
    n.id = static_cast<uint32_t>(builtin->id);
    return true;
  }
  // Mark only the name, without its arguments.
  span.end = span.begin + static_cast<uint32_t>(text(n.name).size());
  span.end_line = span.line;
  span.end_column = span.column + static_cast<int>(text(n.name).size());
  if (found != table->end()) {
    sink_.error(span, codes::kWrongUse, join({"`", text(n.name), "` is an import"}),
                join({"name something of it: ", text(n.name), ".name"}));
  } else {
    unknownName(span, n.name, n.kind == ExprKind::call, shape);
  }
  return true;
}

}  // namespace sgm

// Resolves callees of calls and plain names, also across imports, and suggests names for unknown ones.

#include "grammar/check/symbols.h"
#include "grammar/std/std_library.h"
#include "grammar/syntax/foreign_words.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

void offerBuiltins(Suggestion& suggestion, bool calls) {
  if (!calls) {
    for (const std::string_view word : {"cell", "scope"}) suggestion.offer(word);
    return;
  }
  for (const BuiltinInfo& info : builtinTable())
    if (info.id != Builtin::cell_point && info.id != Builtin::cell_links) suggestion.offer(info.name);
  for (const PrimitiveInfo& info : primitiveTable()) suggestion.offer(info.name);
}

}  // namespace

void Symbols::reportMisusedAsset(const Span& span, NameId name) {
  check_.sink.error(span, codes::kWrongUse, join({"`", check_.text(name), "` is an asset"}),
                    join({"put it into a scope: `fit ", check_.text(name), ";`"}));
}

void Symbols::reportUnknownName(const Span& span, NameId name, const Scope& scope, bool call, bool shape) {
  if (mayBeLost(scope.module, name)) return;
  const std::string_view word = check_.text(name);
  Suggestion suggestion(word);
  for (const Local& local : scope.locals) suggestion.offer(check_.text(local.name));
  for (const auto& [known, symbol] : of(scope.module)) suggestion.offer(check_.text(known));
  offerBuiltins(suggestion, call || shape);
  if (const std::string ours = hintFor(word); !ours.empty()) {
    check_.sink.error(span, codes::kUnknownName, join({"unknown name `", word, "`"}), ours);
    return;
  }
  check_.sink.error(span, codes::kUnknownName, join({"unknown name `", word, "`"}),
                    suggestion.hintOr(shape  ? join({"add `rule ", word, " { ... }`"})
                                      : call ? join({"add `let ", word, "(...) = ...;`"})
                                             : join({"add `let ", word, " = ...;`, or `param ", word, " = ...;`"})));
}

/// Handles a receiver (the name before a dot) that is not a known name: if it was probably meant as an imported file,
/// reports that nothing is imported under this name and returns true. Returns true without an error if the name may be
/// declared in text that failed to parse.
bool Symbols::reportMissingImport(const ExprNode& receiver, const Scope& scope, bool shape) {
  const std::string_view word = check_.text(receiver.name);
  if (isValueWord(word)) return false;
  if (mayBeLost(scope.module, receiver.name)) return true;
  const std::string path = join({"std/", word, ".sgm"});
  const bool standard = !standardModule(path).empty();
  if (!standard && !shape) return false;
  Suggestion suggestion(word);
  for (const auto& [name, symbol] : of(scope.module))
    if (symbol.import) suggestion.offer(check_.text(name));
  check_.sink.error(
      receiver.span, codes::kUnknownName, join({"nothing is imported as `", word, "` here"}),
      suggestion.hintOr(join({"add `import \"", standard ? path : join({word, ".sgm"}), "\" as ", word, ";`"})));
  return true;
}

/// Reports that a module, imported as `receiver`, does not declare the callee.
void Symbols::reportAbsent(const ExprNode& call, NameId receiver, uint32_t module) {
  if (mayBeLost(module, call.name)) return;
  Suggestion suggestion(check_.text(call.name));
  std::string all;
  for (const auto& [name, symbol] : of(module)) {
    if (symbol.import || symbol.asset) continue;
    suggestion.offer(check_.text(name));
    all += join({all.empty() ? "it has " : ", ", check_.text(name)});
  }
  check_.sink.error(call.span, codes::kUnknownName,
                    join({"`", check_.text(receiver), "` has no `", check_.text(call.name), "`"}),
                    suggestion.hintOr(all.empty() ? "it declares nothing" : all));
}

bool Symbols::resolveCallee(ExprId call, const Scope& scope, bool shape) {
  ExprNode& n = check_.node(call);
  if (n.ref != Ref::none) return true;
  uint32_t module = scope.module;
  const bool qualified = n.children.count > 0;
  if (qualified) {
    const ExprNode& receiver = check_.node(check_.child(n, 0));
    if (receiver.kind != ExprKind::name) return false;
    const Symbol* const import = find(scope.module, receiver.name);
    const bool hidden = scope.hides(receiver.name);
    if (!hidden && import != nullptr && import->asset) {
      reportMisusedAsset(receiver.span, receiver.name);
      return true;
    }
    if (!hidden && import == nullptr && reportMissingImport(receiver, scope, shape)) return true;
    if (hidden || import == nullptr || !import->import) return false;
    // a module id of kNoId means that the imported file could not be read
    if (import->id == kNoId && mayBeLost(kNoId, n.name)) return true;
    module = import->id;
  }
  const Symbol* const found = find(module, n.name);
  if (found != nullptr && found->asset) {
    reportMisusedAsset(n.span, n.name);
    return true;
  }
  if (found != nullptr && !found->import) {
    n.ref = found->ref;
    n.id = found->id;
    if (qualified) {
      n.qualifier = check_.node(check_.child(n, 0)).name;
      n.children = {};
    }
    return true;
  }
  if (qualified) {
    reportAbsent(n, check_.node(check_.child(n, 0)).name, module);
    return true;
  }
  if (const PrimitiveInfo* primitive = findPrimitive(check_.text(n.name))) {
    n.ref = Ref::primitive;
    n.id = static_cast<uint32_t>(primitive->id);
    return true;
  }
  const BuiltinInfo* builtin = findBuiltin(check_.text(n.name));
  if (builtin != nullptr && builtin->id != Builtin::cell_point && builtin->id != Builtin::cell_links) {
    n.ref = Ref::builtin;
    n.id = static_cast<uint32_t>(builtin->id);
    return true;
  }
  // The message marks only the callee's name, not its arguments.
  Span span = n.span;
  span.end = span.begin + static_cast<uint32_t>(check_.text(n.name).size());
  span.end_line = span.line;
  span.end_column = span.column + static_cast<int>(check_.text(n.name).size());
  if (found != nullptr) {
    check_.sink.error(span, codes::kWrongUse, join({"`", check_.text(n.name), "` is an import"}),
                      join({"name something of it: ", check_.text(n.name), ".name"}));
  } else {
    reportUnknownName(span, n.name, scope, n.kind == ExprKind::call, shape);
  }
  return true;
}

}  // namespace sgm

#include <limits>

#include "grammar/check/check.h"
#include "grammar/text/codes.h"

namespace sgm {

Checker::Checker(Program& program, NameTable& names, std::vector<ModuleSyntax>& syntax, const CompileLimits& limits,
                 DiagnosticSink& sink, bool library)
    : program_(program),
      names_(names),
      syntax_(syntax),
      limits_(limits),
      sink_(sink),
      symbols_(syntax.size()),
      library_(library),
      errors_before_(sink.errorCount()),
      lossy_(errors_before_ > 0) {}

void Checker::run() {
  collect();
  assetMaterials();
  if (sink_.errorCount() > errors_before_) return;
  formalRanges();
  params();
  seedAndDomain();
  layers();
  if (sink_.full()) return;
  checkRules();
  keepCalls();
  layersAsked();
  expectations();
}

bool Checker::mayBeLost(uint32_t module, NameId name) {
  if (module != kNoId && !syntax_[module].mayDeclare(name)) return false;
  uses_lost_ = true;
  return true;
}

IdRange Checker::store(const std::vector<uint32_t>& ids) {
  const IdRange range{static_cast<uint32_t>(program_.ast.ids.size()), static_cast<uint32_t>(ids.size())};
  program_.ast.ids.insert(program_.ast.ids.end(), ids.begin(), ids.end());
  return range;
}

void Checker::declare(ModuleSyntax& module, NameId name, Symbol symbol) {
  const std::string_view word = text(name);
  if (!symbol.import && !symbol.asset && (findBuiltin(word) != nullptr || findPrimitive(word) != nullptr)) {
    sink_.error(symbol.span, codes::kShadowsBuiltin, join({"`", word, "` is built in and cannot be declared again"}),
                join({"choose another name, such as `", word, "_`"}));
    return;
  }
  if (word == "cell" || word == "scope" || word == "p" || word == "q" || word == "u") {
    sink_.error(symbol.span, codes::kShadowsBuiltin, join({"`", word, "` is a value of the language"}),
                join({"choose another name, such as `", word, "_`"}));
    return;
  }
  const auto [at, fresh] = symbols_[module.module].emplace(name, symbol);
  if (!fresh) {
    sink_.error(symbol.span, codes::kDuplicate, join({"`", word, "` is declared twice"}), "rename one of them")
        .notes.push_back(join({"the first is at ", sink_.place(at->second.span)}));
  }
}

void Checker::collect() {
  for (const FormalNode& formal : program_.ast.formals) {
    if (formal.fallback != kNoId && !literal(formal.fallback))
      sink_.error(node(formal.fallback).span, codes::kNotConstant, "a default is made of numbers alone",
                  "such as r = 2m or r = 3*0.5m");
    for (const ExprId end : {formal.low_expr, formal.high_expr})
      if (end != kNoId && !literal(end))
        sink_.error(node(end).span, codes::kNotConstant, "the range of a parameter is made of numbers alone",
                    "such as r in 1m..60m");
  }
  auto rootOnly = [&](const ModuleSyntax& module, const Span& span, std::string_view what) {
    if (module.module != 0)
      sink_.error(span, codes::kImportContent, join({"an imported file has no `", what, "`"}),
                  "imports give lets, fields and rules");
  };
  for (ModuleSyntax& module : syntax_) {
    for (const Item& item : module.items) {
      switch (item.kind) {
        case ItemKind::version:
          break;
        case ItemKind::import: {
          const ImportDecl& import = module.imports[item.index];
          if (import.asset == kNoId)
            declare(module, import.alias, {Ref::none, import.module, true, import.alias_span});
          else
            declare(module, import.alias, {Ref::none, import.asset, false, import.alias_span, true});
          break;
        }
        case ItemKind::units:
          break;
        case ItemKind::param: {
          const Param& param = program_.params[item.index];
          rootOnly(module, param.span, "param");
          declare(module, param.name, {Ref::parameter, item.index, false, param.span});
          break;
        }
        case ItemKind::let: {
          const Let& let = program_.lets[item.index];
          declare(module, let.name, {Ref::let, item.index, false, let.span});
          break;
        }
        case ItemKind::field: {
          const Field& field = program_.fields[item.index];
          declare(module, field.name, {Ref::field, item.index, false, field.span});
          break;
        }
        case ItemKind::alternative: {
          const Rule& rule = program_.rules[item.index];
          if (item.sub == 0) declare(module, rule.name, {Ref::rule, item.index, false, rule.span});
          break;
        }
        case ItemKind::seed:
          rootOnly(module, item.span, "seed");
          break;
        case ItemKind::domain:
          rootOnly(module, item.span, "domain");
          break;
        case ItemKind::layer:
          rootOnly(module, item.span, "layer");
          break;
        case ItemKind::start:
          rootOnly(module, item.span, "start");
          break;
        case ItemKind::overriding:
          rootOnly(module, item.span, "override");
          break;
        case ItemKind::expectation:
          rootOnly(module, item.span, program_.expectations[item.index].expect ? "expect" : "report");
          break;
      }
    }
  }
}

bool Checker::literal(ExprId id) const {
  const ExprNode& n = node(id);
  if (n.kind != ExprKind::number && n.kind != ExprKind::negate && n.kind != ExprKind::binary &&
      n.kind != ExprKind::vector)
    return false;
  for (uint32_t i = 0; i < n.children.count; ++i)
    if (!literal(child(n, i))) return false;
  return true;
}

uint16_t Checker::tableIndex(std::pmr::vector<std::pmr::string>& table, NameId name, const Span& span) {
  const std::string_view word = text(name);
  for (size_t i = 0; i < table.size(); ++i)
    if (table[i] == word) return static_cast<uint16_t>(i);
  constexpr size_t kMost = 4096;
  if (table.size() >= kMost) {
    sink_.error(span, codes::kTooLarge, "the program has more than 4096 different names of one kind",
                "materials, tags and anchors may have that many names each; use some names again");
    return 0;
  }
  table.emplace_back(word);
  return static_cast<uint16_t>(table.size() - 1);
}

}  // namespace sgm

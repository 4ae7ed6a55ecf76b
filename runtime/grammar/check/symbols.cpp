#include "grammar/check/symbols.h"

#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm {

const Symbol* Symbols::find(uint32_t module, NameId name) const {
  const auto found = tables_[module].find(name);
  return found == tables_[module].end() ? nullptr : &found->second;
}

void Symbols::declare(const ModuleSyntax& module, NameId name, const Symbol& symbol) {
  const std::string_view word = check_.text(name);
  if (!symbol.import && !symbol.asset && (findBuiltin(word) != nullptr || findPrimitive(word) != nullptr)) {
    check_.sink.error(symbol.span, codes::kShadowsBuiltin,
                      join({"`", word, "` is built in and cannot be declared again"}),
                      join({"choose another name, such as `", word, "_`"}));
    return;
  }
  if (isValueWord(word)) {
    check_.sink.error(symbol.span, codes::kShadowsBuiltin, join({"`", word, "` is a value of the language"}),
                      join({"choose another name, such as `", word, "_`"}));
    return;
  }
  const auto [at, fresh] = tables_[module.module].emplace(name, symbol);
  if (!fresh) {
    check_.sink.error(symbol.span, codes::kDuplicate, join({"`", word, "` is declared twice"}), "rename one of them")
        .notes.push_back(join({"the first is at ", check_.sink.place(at->second.span)}));
  }
}

void Symbols::collect() {
  auto rootOnly = [&](const ModuleSyntax& module, const Span& span, std::string_view what) {
    if (module.module != 0)
      check_.sink.error(span, codes::kImportContent, join({"an imported file has no `", what, "`"}),
                        "imports give lets, fields and rules");
  };
  for (const ModuleSyntax& module : check_.syntax) {
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
          const Param& param = check_.program.params[item.index];
          rootOnly(module, param.span, "param");
          declare(module, param.name, {Ref::parameter, item.index, false, param.span});
          break;
        }
        case ItemKind::let: {
          const Let& let = check_.program.lets[item.index];
          declare(module, let.name, {Ref::let, item.index, false, let.span});
          break;
        }
        case ItemKind::field: {
          const Field& field = check_.program.fields[item.index];
          declare(module, field.name, {Ref::field, item.index, false, field.span});
          break;
        }
        case ItemKind::alternative: {
          const Rule& rule = check_.program.rules[item.index];
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
          rootOnly(module, item.span, check_.program.expectations[item.index].expect ? "expect" : "report");
          break;
      }
    }
  }
}

bool Symbols::mayBeLost(uint32_t module, NameId name) {
  if (module != kNoId && !check_.syntax[module].mayDeclare(name)) return false;
  uses_lost_ = true;
  return true;
}

uint32_t Symbols::findLayer(NameId name, const Span& span) {
  Suggestion suggestion(check_.text(name));
  uint32_t found = kNoId;
  for (uint32_t l = 0; l < check_.program.layers.size(); ++l) {
    if (check_.program.layers[l].name == name) found = l;
    suggestion.offer(check_.text(check_.program.layers[l].name));
  }
  if (found == kNoId && layers_known_ && !mayBeLost(0, name)) {
    const std::string hint = suggestion.hint();
    check_.sink.error(span, codes::kUnknownName, join({"unknown layer `", check_.text(name), "`"}),
                      hint.empty() ? "name a layer of this file" : hint);
  }
  return found;
}

}  // namespace sgm

#include "grammar/check/layer_level.h"

#include <algorithm>

#include "grammar/check/statement_walk.h"
#include "grammar/text/codes.h"

namespace sgm {

void LayerLevel::mark() {
  std::set<uint32_t> starts;
  const auto add = [&](ExprId call) {
    if (call != kNoId && check_.node(call).ref == Ref::rule) starts.insert(check_.node(call).id);
  };
  add(check_.syntax[0].start);
  for (const LayerDecl& layer : check_.syntax[0].layers) add(layer.start);
  for (const uint32_t rule : starts)
    for (const Alternative& head : check_.program.rules[rule].alternatives) markStatement(head.body);
  for (uint32_t o = 0; o < check_.program.overrides.size(); ++o) {
    const IdRange steps = check_.program.overrides[o].steps;
    if (steps.count != 1) continue;
    const auto& heads = check_.program.rules[check_.program.path_steps[steps.first].rule].alternatives;
    markOverride(o, std::ranges::any_of(heads, [&](const Alternative& head) { return cutsDomain(head.body); }));
  }
}

void LayerLevel::markStatement(StmtId id) {
  StmtNode& s = check_.program.ast.stmts[check_.program.innermost(id)];
  if (s.kind == StmtKind::cut || s.kind == StmtKind::inner) s.layer_level = true;
  if (s.kind != StmtKind::block) return;
  const IdRange edits = check_.program.overridesOf(s.tag);
  if (edits.count > 0) {
    const bool cuts = cutsDomain(check_.program.innermost(id));
    for (uint32_t i = 0; i < edits.count; ++i) markOverride(check_.program.idAt(edits, i), cuts);
  }
  for (uint32_t i = 0; i < s.children.count; ++i) markStatement(check_.program.idAt(s.children, i));
}

void LayerLevel::markOverride(uint32_t index, bool cuts) {
  const StmtId body = check_.program.overrides[index].body;
  if (overrides_.insert(index).second) markStatement(body);
  if (!cuts) return;
  forEachStatement(check_.program, body, [&](const StmtNode& s) {
    if (s.kind == StmtKind::inner && !s.layer_level)
      check_.sink.error(s.span, codes::kWrongUse,
                        "`inner` derives a cut of the domain here, and cannot be inside another shape",
                        "put `inner` into the override's own block, under transforms, loops and `detail` only");
  });
}

bool LayerLevel::cutsDomain(StmtId id) const {
  const StmtNode& s = check_.program.stmt(check_.program.innermost(id));
  if (s.kind == StmtKind::cut) return true;
  bool cuts = false;
  for (uint32_t i = 0; s.kind == StmtKind::block && i < s.children.count && !cuts; ++i)
    cuts = cutsDomain(check_.program.idAt(s.children, i));
  return cuts;
}

}  // namespace sgm

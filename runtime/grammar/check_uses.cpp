// How often a rule can derive another: overrides of uses that never come are told of.

#include <algorithm>
#include <limits>
#include <map>

#include "grammar/check.h"
#include "grammar/codes.h"

namespace sgm {

namespace {

constexpr uint32_t kAnyNumber = std::numeric_limits<uint32_t>::max();

uint32_t sum(uint32_t a, uint32_t b) { return a > kAnyNumber - b ? kAnyNumber : a + b; }

/// The most uses of a rule that one run of a statement derives itself; kAnyNumber where loops or point sets repeat it.
uint32_t usesIn(const Program& program, StmtId id, uint32_t rule) {
  if (id == kNoId) return 0;
  const StmtNode& s = program.stmt(id);
  if (s.kind == StmtKind::call) return program.expr(s.expr).ref == Ref::rule && program.expr(s.expr).id == rule ? 1 : 0;
  uint32_t uses = usesIn(program, s.body, rule);
  for (uint32_t i = 0; i < s.children.count; ++i) uses = sum(uses, usesIn(program, program.idAt(s.children, i), rule));
  switch (s.kind) {
    case StmtKind::block:
    case StmtKind::unite:
    case StmtKind::cut:
    case StmtKind::meet:
    case StmtKind::sum:
    case StmtKind::morph:
    case StmtKind::displace:
    case StmtKind::warp:
    case StmtKind::transform:
    case StmtKind::detail:
      return uses;
    default:
      return uses > 0 ? kAnyNumber : 0;
  }
}

uint32_t usesInCall(const Program& program, ExprId call, uint32_t rule) {
  return call != kNoId && program.expr(call).ref == Ref::rule && program.expr(call).id == rule ? 1 : 0;
}

/// The most uses of a rule below one use of another. One head is taken of those without `lod`, and one of those with
/// each.
uint32_t usesBelow(const Program& program, const Rule& parent, uint32_t rule) {
  uint32_t plain = 0, by_level = 0;
  for (const Alternative& head : parent.alternatives) {
    const uint32_t uses = std::max({usesIn(program, head.body, rule), usesInCall(program, head.depth_call, rule),
                                    usesInCall(program, head.minsize_call, rule)});
    if (head.lod == kNoId)
      plain = std::max(plain, uses);
    else
      by_level = sum(by_level, uses);
  }
  return sum(plain, by_level);
}

}  // namespace

void Checker::usesThatNeverCome() {
  // The block of an override may derive what was there as often as it likes.
  const auto edited = [&](uint32_t rule) { return !program_.rules[rule].overrides.empty(); };
  for (const Override& edit : program_.overrides) {
    for (uint32_t i = 1; i < edit.steps.count; ++i) {
      const PathStep& step = program_.path_steps[edit.steps.first + i];
      const uint32_t parent = program_.path_steps[edit.steps.first + i - 1].rule;
      if (step.index == kNoId || edited(parent)) continue;
      const uint32_t most = usesBelow(program_, program_.rules[parent], step.rule);
      if (most == 0 || step.index < most) continue;
      const std::string_view name = text(program_.rules[step.rule].name);
      sink_.warning(edit.address_span, codes::kIdleOverride,
                    join({"`", text(program_.rules[parent].name), "` derives `", name, "` ",
                          most == 1 ? "once" : std::to_string(most) + " times", " at most: `", name, "[",
                          std::to_string(step.index), "]` never comes"}),
                    join({"the last is `", name, "[", std::to_string(most - 1), "]`"}));
      break;
    }
  }
}

}  // namespace sgm

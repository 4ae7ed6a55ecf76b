// Counts how often one use of a rule can derive another rule, to report overrides whose targets never occur.

#include "grammar/check/idle_overrides.h"

#include <algorithm>
#include <limits>

#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr uint32_t kAnyNumber = std::numeric_limits<uint32_t>::max();

uint32_t sum(uint32_t a, uint32_t b) { return a > kAnyNumber - b ? kAnyNumber : a + b; }

/// Returns the maximum number of times that one execution of `s` (a split, a comp or a treemap) derives `part`, which
/// is one of its parts.
uint32_t timesOf(const StmtNode& s, const PartNode& part) {
  switch (s.kind) {
    case StmtKind::split:
      return part.repeated ? kAnyNumber : 1;
    case StmtKind::comp:
      return part.of == BoxPart::side || part.of == BoxPart::edges ? 4 : 1;
    default:
      return part.floor == FloorPart::room ? 1 : kAnyNumber;
  }
}

/// Returns an upper bound of the number of matching statements that one derivation of statement `id` derives. A
/// statement matches if counts() is true for it. Returns kAnyNumber if a loop or a scatter repeats matching statements.
template <typename Counts>
uint32_t timesIn(const Program& program, StmtId id, const Counts& counts) {
  if (id == kNoId) return 0;
  const StmtNode& s = program.stmt(id);
  if (counts(s)) return 1;
  uint32_t uses = timesIn(program, s.body, counts);
  for (uint32_t i = 0; i < s.children.count; ++i) {
    const uint32_t once = timesIn(program, program.idAt(s.children, i), counts);
    const uint32_t times = once > 0 && i < s.parts.count ? timesOf(s, program.ast.parts[s.parts.first + i]) : 1;
    uses = sum(uses, once > kAnyNumber / times ? kAnyNumber : once * times);
  }
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
    case StmtKind::snap:
    case StmtKind::split:
    case StmtKind::comp:
    case StmtKind::treemap:
      return uses;
    case StmtKind::call:
    case StmtKind::repeat:
    case StmtKind::for_each:
    case StmtKind::scatter:
    case StmtKind::let:
    case StmtKind::field:
    case StmtKind::mat:
    case StmtKind::tag:
    case StmtKind::anchor:
    case StmtKind::link:
    case StmtKind::footprint:
    case StmtKind::extrude:
    case StmtKind::roof:
    case StmtKind::inner:
    case StmtKind::fit:
    case StmtKind::wfc:
    case StmtKind::border:
      return uses > 0 ? kAnyNumber : 0;
  }
  return kAnyNumber;
}

/// Returns an upper bound of the number of direct uses of `rule` in one derivation of statement `id`.
uint32_t usesIn(const Program& program, StmtId id, uint32_t rule) {
  return timesIn(program, id, [&](const StmtNode& s) {
    return s.kind == StmtKind::call && program.expr(s.expr).ref == Ref::rule && program.expr(s.expr).id == rule;
  });
}

/// Whether the block of an override may derive the replaced content more than once.
bool copies(const Program& program, const Override& edit) {
  return timesIn(program, edit.body, [](const StmtNode& s) { return s.kind == StmtKind::inner; }) > 1;
}

uint32_t usesInCall(const Program& program, ExprId call, uint32_t rule) {
  return call != kNoId && program.expr(call).ref == Ref::rule && program.expr(call).id == rule ? 1 : 0;
}

/// Returns an upper bound of the number of times that one use of `parent` directly uses `rule`. One use of `parent`
/// derives one of its heads without `lod`. In addition it derives every head with `lod`, each for some level of detail.
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

void warnOfIdleOverrides(const Program& program, DiagnosticSink& sink) {
  const auto copied = [&](uint32_t rule) {
    const auto& edits = program.rules[rule].overrides;
    return std::any_of(edits.begin(), edits.end(), [&](uint32_t o) { return copies(program, program.overrides[o]); });
  };
  for (const Override& edit : program.overrides) {
    for (uint32_t i = 1; i < edit.steps.count; ++i) {
      const PathStep& step = program.path_steps[edit.steps.first + i];
      const uint32_t parent = program.path_steps[edit.steps.first + i - 1].rule;
      if (step.index == kNoId || copied(parent)) continue;
      const uint32_t most = usesBelow(program, program.rules[parent], step.rule);
      if (most == 0 || step.index < most) continue;
      const std::string_view name = program.text(program.rules[step.rule].name);
      sink.warning(edit.address_span, codes::kIdleOverride,
                   join({"`", program.text(program.rules[parent].name), "` derives `", name, "` ",
                         most == 1 ? "once" : std::to_string(most) + " times", " at most: `", name, "[",
                         std::to_string(step.index), "]` is never derived"}),
                   join({"the last is `", name, "[", std::to_string(most - 1), "]`"}));
      break;
    }
  }
}

}  // namespace sgm

#include "grammar/check/overrides.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "base/hash.h"
#include "grammar/check/idle_overrides.h"
#include "grammar/check/override_paths.h"
#include "grammar/check/statement_walk.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// Calls visit() for each room of a treemap, with the index in Ast::ids of the id of the room's statement, and with the
/// room's tag: the room's name, unless the statement is a block that sets another tag.
template <class Visit>
void forEachRoom(const Program& program, const StmtNode& s, const Visit& visit) {
  for (uint32_t i = 0; s.kind == StmtKind::treemap && i < s.parts.count; ++i) {
    const PartNode& part = program.ast.parts[s.parts.first + i];
    if (part.floor != FloorPart::room) continue;
    const StmtNode& body = program.stmt(program.idAt(s.children, i));
    visit(s.children.first + i, body.kind == StmtKind::block && body.tag != 0 ? body.tag : part.tag);
  }
}

std::set<uint16_t> tagsIn(const Program& program, StmtId body) {
  std::set<uint16_t> tags;
  forEachStatement(program, body, [&](const StmtNode& s) {
    if (s.kind == StmtKind::block && s.tag != 0) tags.insert(s.tag);
    forEachRoom(program, s, [&](uint32_t, uint16_t tag) { tags.insert(tag); });
  });
  return tags;
}

/// The specificity of an override: 0 by tag, 1 by path in every cell, 2 by path in one cell.
int rankOf(const Override& edit) { return edit.by_tag ? 0 : edit.one_cell ? 2 : 1; }

}  // namespace

void Overrides::run() {
  const uint32_t before = check_.sink.errorCount();
  if (check_.program.overrides.empty()) return;
  if (check_.lossy) symbols_.expectLoss();
  if (!symbols_.areLayersKnown()) {
    if (before == 0)
      check_.sink.error(check_.program.overrides[0].span, codes::kNoStart,
                        "nothing is derived here that could be edited",
                        "put overrides into the file with the layers, or with the start");
    return;
  }
  OverridePaths paths(check_, symbols_, rule_uses_.calls);
  // Overrides with the same address are derived within each other (by `inner`), so each needs a hash of its own for its
  // random draws.
  std::map<std::pair<NameId, bool>, uint64_t> same;
  for (Override& edit : check_.program.overrides) {
    edit.hash = hashCombine(hashText(check_.text(edit.address)), edit.by_tag);
    if (const uint64_t earlier = same[{edit.address, edit.by_tag}]++; earlier > 0)
      edit.hash = hashCombine(edit.hash, earlier);
    if (!edit.by_tag && !check_.sink.full()) paths.resolve(edit);
  }
  if (check_.sink.errorCount() > before) return;
  std::stable_sort(check_.program.overrides.begin(), check_.program.overrides.end(),
                   [](const Override& a, const Override& b) { return rankOf(a) < rankOf(b); });
  checkBlocks();
  // If a part of the text was not parsed, rules and tags may be declared there, so the following checks are skipped.
  if (check_.sink.errorCount() > before || check_.lossy) return;
  findTags();
  orderPaths();
  reportHidden();
  assignToRules();
  warnOfIdleOverrides(check_.program, check_.sink);
}

void Overrides::checkBlocks() {
  uses_.resize(check_.program.overrides.size());
  for (uint32_t o = 0; o < check_.program.overrides.size() && !check_.sink.full(); ++o) {
    const Override& edit = check_.program.overrides[o];
    if (edit.by_tag || edit.steps.count > 0) uses_[o] = statements_.checkOverride(o);
  }
  statements_.checkWaiting();
}

/// Finds the blocks that overrides by tag replace.
void Overrides::findTags() {
  std::set<uint16_t> given;
  for (uint32_t r = 0; r < check_.program.rules.size(); ++r) {
    if (!rules_.isChecked(r)) continue;
    for (const Alternative& a : check_.program.rules[r].alternatives) given.merge(tagsIn(check_.program, a.body));
  }
  for (const Override& edit : check_.program.overrides) given.merge(tagsIn(check_.program, edit.body));
  std::map<uint16_t, std::vector<uint32_t>> found;
  for (uint32_t o = 0; o < check_.program.overrides.size(); ++o) {
    const Override& edit = check_.program.overrides[o];
    if (!edit.by_tag) continue;
    Suggestion suggestion(check_.text(edit.address));
    uint16_t tag = 0;
    for (const uint16_t t : given) {
      if (std::string_view(check_.program.tags[t]) == check_.text(edit.address)) tag = t;
      suggestion.offer(check_.program.tags[t]);
    }
    if (tag == 0)
      check_.sink.error(edit.address_span, codes::kUnknownName,
                        join({"nothing here has the tag \"", check_.text(edit.address), "\""}),
                        suggestion.hintOr("write `tag` and this text in the block that it replaces"));
    else
      found[tag].push_back(o);
  }
  check_.program.tag_overrides.assign(check_.program.tags.size(), IdRange{});
  for (const auto& [tag, list] : found) check_.program.tag_overrides[tag] = check_.store(list);
  if (!found.empty()) tagRooms();
}

/// Turns the content of each room whose tag (forEachRoom()) is overridden into a block with that tag.
void Overrides::tagRooms() {
  // for each room: the index in Ast::ids of the id of its statement, and its tag
  std::vector<std::pair<uint32_t, uint16_t>> rooms;
  for (const StmtNode& s : check_.program.ast.stmts) {
    forEachRoom(check_.program, s, [&](uint32_t place, uint16_t tag) {
      if (check_.program.overridesOf(tag).count > 0) rooms.emplace_back(place, tag);
    });
  }
  for (const auto& [place, tag] : rooms) {
    StmtId body = check_.program.ast.ids[place];
    if (check_.program.stmt(body).kind != StmtKind::block) {
      StmtNode block;
      block.kind = StmtKind::block;
      block.span = check_.program.stmt(body).span;
      block.children = check_.store({body});
      check_.program.ast.stmts.push_back(block);
      body = static_cast<StmtId>(check_.program.ast.stmts.size() - 1);
      check_.program.ast.ids[place] = body;
    }
    check_.program.ast.stmts[body].tag = tag;
    const IdRange edits = check_.program.overridesOf(tag);
    for (uint32_t i = 0; i < edits.count; ++i) in_rooms_.insert(check_.program.idAt(edits, i));
  }
}

/// Sorts the path overrides by their steps: each step first by its rule, then by its index.
void Overrides::orderPaths() {
  std::pmr::vector<uint32_t>& order = check_.program.path_overrides;
  for (uint32_t o = 0; o < check_.program.overrides.size(); ++o)
    if (!check_.program.overrides[o].by_tag) order.push_back(o);
  const auto stepsOf = [&](uint32_t o) {
    const IdRange steps = check_.program.overrides[o].steps;
    return std::span(check_.program.path_steps).subspan(steps.first, steps.count);
  };
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::ranges::lexicographical_compare(stepsOf(a), stepsOf(b));
  });
}

/// Reports each override that has no effect, because a later override with the same address replaces it without using
/// `inner`.
void Overrides::reportHidden() {
  const auto same = [&](const Override& a, const Override& b) {
    if (a.by_tag != b.by_tag || a.layer != b.layer || a.one_cell != b.one_cell || a.cell != b.cell) return false;
    if (a.by_tag) return a.address == b.address;
    const auto first = check_.program.path_steps.begin() + a.steps.first,
               second = check_.program.path_steps.begin() + b.steps.first;
    return std::equal(first, first + a.steps.count, second, second + b.steps.count);
  };
  std::map<uint64_t, std::vector<uint32_t>> by_end;
  for (uint32_t o = 0; o < check_.program.overrides.size(); ++o) {
    const Override& edit = check_.program.overrides[o];
    uint64_t end = hashCombine(edit.by_tag ? edit.address : edit.layer, edit.by_tag);
    for (int axis = 0; axis < 3; ++axis) end = hashCombine(end, static_cast<uint64_t>(int64_t{edit.cell[axis]}));
    for (uint32_t i = 0; i < edit.steps.count; ++i) {
      const PathStep& step = check_.program.path_steps[edit.steps.first + i];
      end = hashCombine(hashCombine(end, step.rule), step.index);
    }
    std::vector<uint32_t>& alike = by_end[end];
    bool derives = false;
    forEachStatement(check_.program, edit.body,
                     [&](const StmtNode& s) { derives = derives || s.kind == StmtKind::inner; });
    for (const uint32_t earlier : alike) {
      if (derives || !same(check_.program.overrides[earlier], edit)) continue;
      check_.sink
          .error(edit.address_span, codes::kDuplicate,
                 "this path or tag already has an override, which this one leaves out",
                 "derive it with `inner;`, or remove one of them")
          .notes.push_back(
              join({"the first is at ", check_.sink.place(check_.program.overrides[earlier].address_span)}));
      break;
    }
    alike.push_back(o);
  }
}

/// Assigns each rule its overrides, their calls, and the layers they query.
void Overrides::assignToRules() {
  std::vector<std::set<uint16_t>> tags;
  std::vector<std::vector<uint32_t>> by_path(check_.program.rules.size());
  for (uint32_t o = 0; o < check_.program.overrides.size(); ++o) {
    const Override& edit = check_.program.overrides[o];
    tags.push_back(tagsIn(check_.program, edit.body));
    if (edit.steps.count > 0)
      by_path[check_.program.path_steps[edit.steps.first + edit.steps.count - 1].rule].push_back(o);
  }
  for (uint32_t r = 0; r < check_.program.rules.size(); ++r) {
    Rule& rule = check_.program.rules[r];
    std::set<uint32_t> held;
    std::vector<uint32_t> open = by_path[r];
    const auto tagged = [&](const std::set<uint16_t>& given) {
      for (const uint16_t tag : given) {
        const IdRange more = check_.program.overridesOf(tag);
        for (uint32_t i = 0; i < more.count; ++i) open.push_back(check_.program.idAt(more, i));
      }
    };
    for (const Alternative& a : rule.alternatives) tagged(tagsIn(check_.program, a.body));
    // Blocks with tags may also occur within the overrides' own blocks, and may be overridden there.
    while (!open.empty()) {
      const uint32_t o = open.back();
      open.pop_back();
      if (held.insert(o).second) tagged(tags[o]);
    }
    rule.overrides.assign(held.begin(), held.end());
    for (const uint32_t o : rule.overrides) {
      // These calls of overrides count as calls of the rule. They cause no unbounded recursion, since an override does
      // not apply again within its own block.
      for (const RuleCall& call : uses_[o].calls) rule.calls.push_back(call.to);
      for (const AskedLayer& asked : uses_[o].asked)
        rule_uses_.asked.push_back({r, asked.layer, asked.span, asked.verb});
    }
  }
}

}  // namespace sgm

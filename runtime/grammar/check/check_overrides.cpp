#include <algorithm>

#include "base/hash.h"
#include "grammar/check/check.h"
#include "grammar/syntax/lexer.h"
#include "grammar/syntax/override_path.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr size_t kDeepestPath = 64;  // DeriveLimits::depth
constexpr std::string_view kExample = "such as \"net(0, 0, -1)/Node/Chamber[0]\", as messages print it";

/// The span of a part of an address in the source. After an escaped quote it would be wrong.
Span spanIn(const Override& edit, const PathPlace& place) {
  Span span = edit.address_span;
  const uint32_t length = span.end - span.begin - 2;
  if (place.end > length) return span;
  span.begin += 1 + place.begin;
  span.end = edit.address_span.begin + 1 + place.end;
  span.column += 1 + static_cast<int>(place.begin);
  span.end_column = span.column + static_cast<int>(place.end - place.begin);
  return span;
}

/// Visits every statement of a body, in source order.
template <class Visit>
void forEachStatement(const Program& program, StmtId id, const Visit& visit) {
  if (id == kNoId) return;
  const StmtNode& s = program.stmt(id);
  visit(s);
  forEachStatement(program, s.body, visit);
  for (uint32_t i = 0; i < s.children.count; ++i) forEachStatement(program, program.idAt(s.children, i), visit);
}

/// Visits the content of each room of a treemap: its index in Ast::ids, and its tag, which is the room's name unless a
/// block sets another.
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

/// Higher for more specific overrides.
int rankOf(const Override& edit) { return edit.by_tag ? 0 : edit.one_cell ? 2 : 1; }

}  // namespace

/// Runs after all rules reachable from starts are checked, so that the names in overrides are known, and so that
/// materials first named in overrides come last: the other numbers are then the same as without overrides.
void Checker::overrides() {
  const uint32_t before = sink_.errorCount();
  if (program_.overrides.empty()) return;
  uses_lost_ = uses_lost_ || lossy_;
  if (!layers_known_) {
    if (before == 0)
      sink_.error(program_.overrides[0].span, codes::kNoStart, "nothing is derived here that could be edited",
                  "put overrides into the file with the layers, or with the start");
    return;
  }
  callees_.assign(program_.rules.size(), {});
  for (const RuleCall& call : calls_) callees_[call.from].emplace(call.to, node(call.call).qualifier);
  // Overrides of one address derive within each other, so each needs its own random draws.
  std::map<std::pair<NameId, bool>, uint64_t> same;
  for (Override& edit : program_.overrides) {
    edit.hash = hashCombine(hashText(text(edit.address)), edit.by_tag);
    if (const uint64_t earlier = same[{edit.address, edit.by_tag}]++; earlier > 0)
      edit.hash = hashCombine(edit.hash, earlier);
    if (!edit.by_tag && !sink_.full()) overridePath(edit);
  }
  if (sink_.errorCount() > before) return;
  std::stable_sort(program_.overrides.begin(), program_.overrides.end(),
                   [](const Override& a, const Override& b) { return rankOf(a) < rankOf(b); });
  override_calls_.assign(program_.overrides.size(), {});
  override_asked_.assign(program_.overrides.size(), {});
  for (uint32_t o = 0; o < program_.overrides.size() && !sink_.full(); ++o)
    if (program_.overrides[o].by_tag || program_.overrides[o].steps.count > 0) overrideBlock(o);
  checkWaiting();
  // The unparsed part of the text may have further rules and tags.
  if (sink_.errorCount() > before || lossy_) return;
  overrideTags();
  orderPaths();
  hiddenOverrides();
  holdOverrides();
  usesThatNeverCome();
}

uint32_t Checker::ruleOfStep(uint32_t module, const WrittenStep& step) {
  const std::map<NameId, Symbol>* table = &symbols_[module];
  if (!step.qualifier.empty()) {
    const auto import = table->find(names_.intern(step.qualifier));
    if (import == table->end() || !import->second.import || import->second.id == kNoId) return kNoId;
    table = &symbols_[import->second.id];
  }
  const auto rule = table->find(names_.intern(step.name));
  return rule != table->end() && rule->second.ref == Ref::rule ? rule->second.id : kNoId;
}

/// The tag most likely intended by a path that matches nothing; or empty.
std::string Checker::tagMeant(std::string_view path) const {
  constexpr std::string_view kTag = "tag";
  if (path.starts_with(kTag) && path.size() > kTag.size() + 1 && (path[3] == ':' || path[3] == ' ' || path[3] == '='))
    return std::string(path.substr(std::min(path.find_first_not_of(": =", kTag.size()), path.size())));
  const auto isRule = [&](const Rule& rule) { return text(rule.name) == path; };
  if (std::any_of(program_.rules.begin(), program_.rules.end(), isRule)) return {};
  for (const std::pmr::string& tag : program_.tags)
    if (!tag.empty() && std::string_view(tag) == path) return std::string(path);
  return {};
}

void Checker::overridePath(Override& edit) {
  const std::string path(text(edit.address));
  if (const std::string tag = tagMeant(path); !tag.empty()) {
    sink_.error(edit.address_span, codes::kSyntax, join({"\"", path, "\" is not a path of rules"}),
                join({"write `override tag ", quoteText(tag), "` for the blocks with that tag"}));
    return;
  }
  const WrittenPath written = parsePath(path);
  const auto textAt = [&](const PathPlace& place) {
    return std::string_view(path).substr(place.begin, place.end - place.begin);
  };
  if (!written.wanted.empty()) {
    sink_.error(spanIn(edit, written.wrong), codes::kSyntax, join({"expected ", written.wanted, " in this path"}),
                std::string(kExample));
    return;
  }
  if (written.steps.size() > kDeepestPath) {
    sink_.error(edit.address_span, codes::kTooDeep, "rules may be nested at most 64 deep",
                "write a path of 64 rules at most");
    return;
  }
  if (!written.layer.empty() && !overrideCell(edit, written)) return;

  const auto nameOf = [&](uint32_t rule, NameId qualifier) {
    return qualifier == kNoId ? std::string(text(program_.rules[rule].name))
                              : join({text(qualifier), ".", text(program_.rules[rule].name)});
  };
  const auto unknown = [&](const WrittenStep& step, std::string_view who, const std::vector<std::string>& known) {
    if (lossy_) return;
    // Messages use such a step for content derived within an override.
    if (step.name == "override") {
      sink_.error(spanIn(edit, step.place), codes::kUnknownName, join({who, " `override`"}),
                  "edit the block of that override");
      return;
    }
    Suggestion suggestion(
        textAt({step.place.begin, step.place.begin + static_cast<uint32_t>(step.name.size() + step.qualifier.size() +
                                                                           (step.qualifier.empty() ? 0 : 1))}));
    for (const std::string& name : known) suggestion.offer(name);
    std::string hint = suggestion.hint();
    constexpr size_t kMostNamed = 8;
    for (size_t i = 0; suggestion.best().empty() && i < std::min(known.size(), kMostNamed); ++i)
      hint += join({hint.empty() ? "it derives " : ", ", known[i]});
    sink_.error(spanIn(edit, step.place), codes::kUnknownName, join({who, " `", textAt(step.place), "`"}), hint);
  };
  std::vector<PathStep> steps;
  uint32_t parent = kNoId;
  for (const WrittenStep& step : written.steps) {
    const uint32_t rule = ruleOfStep(parent == kNoId ? 0 : program_.rules[parent].module, step);
    std::vector<std::string> known;
    bool found = false;
    if (parent == kNoId) {
      for (uint32_t l = 0; l < program_.layers.size(); ++l) {
        const ExprNode& start = node(program_.layers[l].start);
        if (start.ref != Ref::rule || (edit.layer != kNoId && edit.layer != l)) continue;
        found = found || start.id == rule;
        known.push_back(nameOf(start.id, start.qualifier));
      }
      if (!found)
        return unknown(step, edit.layer == kNoId ? "no layer starts with" : "this layer does not start with", known);
      if (step.index) {
        sink_.error(spanIn(edit, step.place), codes::kSyntax, "a start has no number",
                    join({"write `", nameOf(rule, kNoId), "`"}));
        return;
      }
    } else {
      for (const auto& [to, qualifier] : callees_[parent]) {
        found = found || to == rule;
        known.push_back(nameOf(to, qualifier));
      }
      if (!found) return unknown(step, join({"`", text(program_.rules[parent].name), "` derives no"}), known);
    }
    steps.push_back({rule, step.index.value_or(kNoId)});
    parent = rule;
  }
  edit.steps = {static_cast<uint32_t>(program_.path_steps.size()), static_cast<uint32_t>(steps.size())};
  program_.path_steps.insert(program_.path_steps.end(), steps.begin(), steps.end());
}

bool Checker::overrideCell(Override& edit, const WrittenPath& written) {
  Suggestion suggestion(written.layer);
  for (uint32_t l = 0; l < program_.layers.size(); ++l) {
    if (text(program_.layers[l].name) == written.layer) edit.layer = l;
    suggestion.offer(text(program_.layers[l].name));
  }
  if (edit.layer == kNoId) {
    if (lossy_) return false;
    sink_.error(spanIn(edit, written.layer_place), codes::kUnknownName, join({"unknown layer `", written.layer, "`"}),
                suggestion.hintOr("name a layer of this file"));
    return false;
  }
  const Layer& layer = program_.layers[edit.layer];
  edit.one_cell = true;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t at = written.cell[static_cast<size_t>(axis)];
    edit.cell[axis] = static_cast<int32_t>(at);
    const int64_t edge = layer.cell_expr == kNoId ? 0 : layer.cell[axis];
    const int64_t low = at * edge, high = low + edge;
    if ((edge > 0 || at == 0) && low >= std::numeric_limits<int32_t>::min() &&
        high <= std::numeric_limits<int32_t>::max())
      continue;
    sink_.error(spanIn(edit, written.cell_place), codes::kValueRange,
                edge == 0 ? join({"`", text(layer.name), "` has no cells along ", std::string(1, "xyz"[axis])})
                          : "this cell lies beyond the end of the world",
                edge == 0 ? "its number is 0 there" : "the world ends at 2097 km");
    return false;
  }
  return true;
}

/// The block replaces every head of the rule, and uses the parameter names of the first.
void Checker::headsAgree(const Override& edit, uint32_t rule, uint32_t parameter) {
  const auto& heads = program_.rules[rule].alternatives;
  const auto nameIn = [&](const Alternative& head) {
    return program_.ast.formals[head.formals.first + parameter].name;
  };
  for (const Alternative& head : heads) {
    if (nameIn(head) == nameIn(heads[0])) continue;
    sink_.warning(edit.address_span, codes::kParameterNames,
                  join({"the heads of `", text(program_.rules[rule].name), "` call one parameter `",
                        text(nameIn(heads[0])), "` and `", text(nameIn(head)), "`"}),
                  join({"here it is `", text(nameIn(heads[0])), "`, as in the first: use one name in all of them"}));
    return;
  }
}

void Checker::overrideBlock(uint32_t index) {
  override_ = index;
  rule_ = kNoId;
  alternative_ = 0;
  known_local_.clear();
  scales_.clear();
  ordinal_ = draws_ = 0;
  scope_ = {};
  scope_.rule = true;
  scope_.draws = &draws_;
  const Override edit = program_.overrides[index];
  if (edit.steps.count > 0) {
    const uint32_t rule = program_.path_steps[edit.steps.first + edit.steps.count - 1].rule;
    const IdRange formals = program_.rules[rule].alternatives[0].formals;
    for (uint32_t i = 0; i < formals.count; ++i) {
      const FormalNode formal = program_.ast.formals[formals.first + i];
      headsAgree(edit, rule, i);
      declareLocal(formal.name, formal.span, {formal.name, i, rule_types_[rule][i], kNoId, 0});
    }
    scope_.next_slot = scope_.slot_count = formals.count;
  }
  statement(edit.body, false);
  program_.overrides[index].slot_count = scope_.slot_count;
  override_ = kNoId;
}

/// Finds the blocks that overrides by tag replace.
void Checker::overrideTags() {
  std::set<uint16_t> given;
  for (uint32_t r = 0; r < program_.rules.size(); ++r) {
    if (rule_state_[r] != 2) continue;
    for (const Alternative& a : program_.rules[r].alternatives) given.merge(tagsIn(program_, a.body));
  }
  for (const Override& edit : program_.overrides) given.merge(tagsIn(program_, edit.body));
  std::map<uint16_t, std::vector<uint32_t>> found;
  for (uint32_t o = 0; o < program_.overrides.size(); ++o) {
    const Override& edit = program_.overrides[o];
    if (!edit.by_tag) continue;
    Suggestion suggestion(text(edit.address));
    uint16_t tag = 0;
    for (const uint16_t t : given) {
      if (std::string_view(program_.tags[t]) == text(edit.address)) tag = t;
      suggestion.offer(program_.tags[t]);
    }
    if (tag == 0)
      sink_.error(edit.address_span, codes::kUnknownName,
                  join({"nothing here has the tag \"", text(edit.address), "\""}),
                  suggestion.hintOr("write `tag` and this text in the block that it replaces"));
    else
      found[tag].push_back(o);
  }
  program_.tag_overrides.assign(program_.tags.size(), IdRange{});
  for (const auto& [tag, list] : found) program_.tag_overrides[tag] = store(list);
  if (!found.empty()) tagRooms();
}

/// A room with an overridden name becomes a block with that tag, as if it had been written.
void Checker::tagRooms() {
  std::vector<std::pair<uint32_t, uint16_t>> rooms;  // indices in Ast::ids
  for (const StmtNode& s : program_.ast.stmts) {
    forEachRoom(program_, s, [&](uint32_t place, uint16_t tag) {
      if (program_.overridesOf(tag).count > 0) rooms.emplace_back(place, tag);
    });
  }
  for (const auto& [place, tag] : rooms) {
    StmtId body = program_.ast.ids[place];
    if (program_.stmt(body).kind != StmtKind::block) {
      StmtNode block;
      block.kind = StmtKind::block;
      block.span = program_.stmt(body).span;
      block.children = store({body});
      program_.ast.stmts.push_back(block);
      body = static_cast<StmtId>(program_.ast.stmts.size() - 1);
      program_.ast.ids[place] = body;
    }
    program_.ast.stmts[body].tag = tag;
    const IdRange edits = program_.overridesOf(tag);
    for (uint32_t i = 0; i < edits.count; ++i) room_overrides_.insert(program_.idAt(edits, i));
  }
}

/// Sorts the overrides by path by the rules and indices of their steps.
void Checker::orderPaths() {
  std::pmr::vector<uint32_t>& order = program_.path_overrides;
  for (uint32_t o = 0; o < program_.overrides.size(); ++o)
    if (!program_.overrides[o].by_tag) order.push_back(o);
  const auto stepsOf = [&](uint32_t o) {
    const IdRange steps = program_.overrides[o].steps;
    return std::span(program_.path_steps).subspan(steps.first, steps.count);
  };
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::ranges::lexicographical_compare(stepsOf(a), stepsOf(b));
  });
}

/// Reports an override that does not derive `inner` of an earlier one with the same address, which then has no effect.
void Checker::hiddenOverrides() {
  const auto same = [&](const Override& a, const Override& b) {
    if (a.by_tag != b.by_tag || a.layer != b.layer || a.one_cell != b.one_cell || a.cell != b.cell) return false;
    if (a.by_tag) return a.address == b.address;
    const auto first = program_.path_steps.begin() + a.steps.first,
               second = program_.path_steps.begin() + b.steps.first;
    return std::equal(first, first + a.steps.count, second, second + b.steps.count);
  };
  std::map<uint64_t, std::vector<uint32_t>> by_end;
  for (uint32_t o = 0; o < program_.overrides.size(); ++o) {
    const Override& edit = program_.overrides[o];
    uint64_t end = hashCombine(edit.by_tag ? edit.address : edit.layer, edit.by_tag);
    for (int axis = 0; axis < 3; ++axis) end = hashCombine(end, static_cast<uint64_t>(int64_t{edit.cell[axis]}));
    for (uint32_t i = 0; i < edit.steps.count; ++i) {
      const PathStep& step = program_.path_steps[edit.steps.first + i];
      end = hashCombine(hashCombine(end, step.rule), step.index);
    }
    std::vector<uint32_t>& alike = by_end[end];
    bool derives = false;
    forEachStatement(program_, edit.body, [&](const StmtNode& s) { derives = derives || s.kind == StmtKind::inner; });
    for (const uint32_t earlier : alike) {
      if (derives || !same(program_.overrides[earlier], edit)) continue;
      sink_
          .error(edit.address_span, codes::kDuplicate,
                 "this path or tag already has an override, which this one leaves out",
                 "derive it with `inner;`, or remove one of them")
          .notes.push_back(join({"the first is at ", sink_.place(program_.overrides[earlier].address_span)}));
      break;
    }
    alike.push_back(o);
  }
}

/// Assigns each rule its overrides, their calls, and the layers they query.
void Checker::holdOverrides() {
  std::vector<std::set<uint16_t>> tags;
  std::vector<std::vector<uint32_t>> by_path(program_.rules.size());
  for (uint32_t o = 0; o < program_.overrides.size(); ++o) {
    const Override& edit = program_.overrides[o];
    tags.push_back(tagsIn(program_, edit.body));
    if (edit.steps.count > 0) by_path[program_.path_steps[edit.steps.first + edit.steps.count - 1].rule].push_back(o);
  }
  for (uint32_t r = 0; r < program_.rules.size(); ++r) {
    Rule& rule = program_.rules[r];
    std::set<uint32_t> held;
    std::vector<uint32_t> open = by_path[r];
    const auto tagged = [&](const std::set<uint16_t>& given) {
      for (const uint16_t tag : given) {
        const IdRange more = program_.overridesOf(tag);
        for (uint32_t i = 0; i < more.count; ++i) open.push_back(program_.idAt(more, i));
      }
    };
    for (const Alternative& a : rule.alternatives) tagged(tagsIn(program_, a.body));
    // The blocks of overrides may have tags, too.
    while (!open.empty()) {
      const uint32_t o = open.back();
      open.pop_back();
      if (held.insert(o).second) tagged(tags[o]);
    }
    rule.overrides.assign(held.begin(), held.end());
    for (const uint32_t o : rule.overrides) {
      rule.calls.insert(rule.calls.end(), override_calls_[o].begin(), override_calls_[o].end());
      for (const AskedLayer& asked : override_asked_[o]) asked_.push_back({r, asked.layer, asked.span, asked.verb});
    }
  }
}

/// `inner` in an override's block is at layer level if cuts in that place would be.
void Checker::markOverrides(IdRange overrides, bool cuts) {
  for (uint32_t i = 0; i < overrides.count; ++i) markOverride(program_.idAt(overrides, i), cuts);
}

void Checker::markOverride(uint32_t index, bool cuts) {
  const StmtId body = program_.overrides[index].body;
  if (level_overrides_.insert(index).second) markLayerLevel(body);
  if (!cuts) return;
  forEachStatement(program_, body, [&](const StmtNode& s) {
    if (s.kind == StmtKind::inner && !s.layer_level)
      sink_.error(s.span, codes::kWrongUse,
                  "`inner` derives a cut of the domain here, and cannot be inside another shape",
                  "put `inner` into the override's own block, under transforms, loops and `detail` only");
  });
}

bool Checker::cutsDomain(StmtId id) const {
  const StmtNode& s = program_.stmt(program_.innermost(id));
  if (s.kind == StmtKind::cut) return true;
  bool cuts = false;
  for (uint32_t i = 0; s.kind == StmtKind::block && i < s.children.count && !cuts; ++i)
    cuts = cutsDomain(program_.idAt(s.children, i));
  return cuts;
}

}  // namespace sgm

#include "grammar/check/override_paths.h"

#include <algorithm>
#include <limits>

#include "grammar/syntax/lexer.h"
#include "grammar/syntax/override_path.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr size_t kDeepestPath = 64;  // DeriveLimits::depth
constexpr std::string_view kExample = "such as \"net(0, 0, -1)/Node/Chamber[0]\", as messages print it";

/// Returns the span in the source of a part of an address. For a part after an escaped quote, the span is wrong: the
/// escaped quote is longer in the source than in the address.
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

/// Returns the tag that the author probably meant by a path that matches no rule; empty if no tag fits.
std::string tagMeant(const Program& program, std::string_view path) {
  constexpr std::string_view kTag = "tag";
  if (path.starts_with(kTag) && path.size() > kTag.size() + 1 && (path[3] == ':' || path[3] == ' ' || path[3] == '='))
    return std::string(path.substr(std::min(path.find_first_not_of(": =", kTag.size()), path.size())));
  const auto isRule = [&](const Rule& rule) { return program.text(rule.name) == path; };
  if (std::any_of(program.rules.begin(), program.rules.end(), isRule)) return {};
  for (const std::pmr::string& tag : program.tags)
    if (!tag.empty() && std::string_view(tag) == path) return std::string(path);
  return {};
}

}  // namespace

OverridePaths::OverridePaths(CheckContext& check, const Symbols& symbols, const std::vector<RuleCall>& calls)
    : check_(check), symbols_(symbols), callees_(check.program.rules.size()) {
  for (const RuleCall& call : calls) callees_[call.from].emplace(call.to, check.node(call.call).qualifier);
}

uint32_t OverridePaths::ruleOf(uint32_t module, const WrittenStep& step) const {
  if (!step.qualifier.empty()) {
    const Symbol* const import = symbols_.find(module, check_.names.intern(step.qualifier));
    if (import == nullptr || !import->import || import->id == kNoId) return kNoId;
    module = import->id;
  }
  const Symbol* const rule = symbols_.find(module, check_.names.intern(step.name));
  return rule != nullptr && rule->ref == Ref::rule ? rule->id : kNoId;
}

std::string OverridePaths::nameOf(uint32_t rule, NameId qualifier) const {
  const std::string_view name = check_.text(check_.program.rules[rule].name);
  return qualifier == kNoId ? std::string(name) : join({check_.text(qualifier), ".", name});
}

void OverridePaths::resolve(Override& edit) {
  const std::string path(check_.text(edit.address));
  if (const std::string tag = tagMeant(check_.program, path); !tag.empty()) {
    check_.sink.error(edit.address_span, codes::kSyntax, join({"\"", path, "\" is not a path of rules"}),
                      join({"write `override tag ", quoteText(tag), "` for the blocks with that tag"}));
    return;
  }
  const WrittenPath written = parsePath(path);
  if (!written.wanted.empty()) {
    check_.sink.error(spanIn(edit, written.wrong), codes::kSyntax, join({"expected ", written.wanted, " in this path"}),
                      std::string(kExample));
    return;
  }
  if (written.steps.size() > kDeepestPath) {
    check_.sink.error(edit.address_span, codes::kTooDeep, "rules may be nested at most 64 deep",
                      "write a path of 64 rules at most");
    return;
  }
  if (!written.layer.empty() && !findCell(edit, written)) return;
  std::vector<PathStep> steps;
  if (!findSteps(edit, written, steps)) return;
  edit.steps = {static_cast<uint32_t>(check_.program.path_steps.size()), static_cast<uint32_t>(steps.size())};
  check_.program.path_steps.insert(check_.program.path_steps.end(), steps.begin(), steps.end());
}

bool OverridePaths::findCell(Override& edit, const WrittenPath& written) {
  Suggestion suggestion(written.layer);
  for (uint32_t l = 0; l < check_.program.layers.size(); ++l) {
    if (check_.text(check_.program.layers[l].name) == written.layer) edit.layer = l;
    suggestion.offer(check_.text(check_.program.layers[l].name));
  }
  if (edit.layer == kNoId) {
    if (check_.lossy) return false;
    check_.sink.error(spanIn(edit, written.layer_place), codes::kUnknownName,
                      join({"unknown layer `", written.layer, "`"}), suggestion.hintOr("name a layer of this file"));
    return false;
  }
  const Layer& layer = check_.program.layers[edit.layer];
  edit.one_cell = true;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t at = written.cell[static_cast<size_t>(axis)];
    edit.cell[axis] = static_cast<int32_t>(at);
    const int64_t edge = layer.cell_expr == kNoId ? 0 : layer.cell[axis];
    const int64_t low = at * edge, high = low + edge;
    if ((edge > 0 || at == 0) && low >= std::numeric_limits<int32_t>::min() &&
        high <= std::numeric_limits<int32_t>::max())
      continue;
    check_.sink.error(spanIn(edit, written.cell_place), codes::kValueRange,
                      edge == 0
                          ? join({"`", check_.text(layer.name), "` has no cells along ", std::string(1, "xyz"[axis])})
                          : "this cell lies beyond the end of the world",
                      edge == 0 ? "its number is 0 there" : "the world ends at 2097 km");
    return false;
  }
  return true;
}

bool OverridePaths::findSteps(const Override& edit, const WrittenPath& written, std::vector<PathStep>& steps) {
  for (const WrittenStep& step : written.steps) {
    const uint32_t parent = steps.empty() ? kNoId : steps.back().rule;
    const uint32_t rule = ruleOf(parent == kNoId ? 0 : check_.program.rules[parent].module, step);
    if (parent == kNoId ? !findStart(edit, step, rule) : !findCallee(edit, step, parent, rule)) return false;
    steps.push_back({rule, step.index.value_or(kNoId)});
  }
  return true;
}

bool OverridePaths::findStart(const Override& edit, const WrittenStep& step, uint32_t rule) {
  std::vector<std::string> known;
  bool found = false;
  for (uint32_t l = 0; l < check_.program.layers.size(); ++l) {
    const ExprNode& start = check_.node(check_.program.layers[l].start);
    if (start.ref != Ref::rule || (edit.layer != kNoId && edit.layer != l)) continue;
    found = found || start.id == rule;
    known.push_back(nameOf(start.id, start.qualifier));
  }
  if (!found)
    reportUnknown(edit, step, edit.layer == kNoId ? "no layer starts with" : "this layer does not start with", known);
  else if (step.index)
    check_.sink.error(spanIn(edit, step.place), codes::kSyntax, "a start has no number",
                      join({"write `", nameOf(rule, kNoId), "`"}));
  return found && !step.index;
}

bool OverridePaths::findCallee(const Override& edit, const WrittenStep& step, uint32_t parent, uint32_t rule) {
  std::vector<std::string> known;
  bool found = false;
  for (const auto& [to, qualifier] : callees_[parent]) {
    found = found || to == rule;
    known.push_back(nameOf(to, qualifier));
  }
  if (!found)
    reportUnknown(edit, step, join({"`", check_.text(check_.program.rules[parent].name), "` derives no"}), known);
  return found;
}

void OverridePaths::reportUnknown(const Override& edit, const WrittenStep& step, std::string_view who,
                                  const std::vector<std::string>& known) {
  if (check_.lossy) return;
  // In messages, the step `override` stands for content that an override's block has derived. Such a step cannot be
  // written in a path.
  if (step.name == "override") {
    check_.sink.error(spanIn(edit, step.place), codes::kUnknownName, join({who, " `override`"}),
                      "edit the block of that override");
    return;
  }
  const std::string_view path = check_.text(edit.address);
  const auto textAt = [&](const PathPlace& place) { return path.substr(place.begin, place.end - place.begin); };
  Suggestion suggestion(
      textAt({step.place.begin, step.place.begin + static_cast<uint32_t>(step.name.size() + step.qualifier.size() +
                                                                         (step.qualifier.empty() ? 0 : 1))}));
  for (const std::string& name : known) suggestion.offer(name);
  std::string hint = suggestion.hint();
  constexpr size_t kMaxNamed = 8;
  for (size_t i = 0; suggestion.best().empty() && i < std::min(known.size(), kMaxNamed); ++i)
    hint += join({hint.empty() ? "it derives " : ", ", known[i]});
  check_.sink.error(spanIn(edit, step.place), codes::kUnknownName, join({who, " `", textAt(step.place), "`"}), hint);
}

}  // namespace sgm

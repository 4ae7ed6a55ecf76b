// Footprints, their extrusions, and roofs.

#include <algorithm>

#include "grammar/check/check.h"
#include "grammar/syntax/profile_limits.h"
#include "grammar/text/codes.h"

namespace sgm {

void Checker::demandRange(ExprId id, Dim dim, std::string_view what, const ValueRange& range) {
  if (id == kNoId) return;
  const Type type = demand(id, ValueKind::number, dim, what);
  if (!agrees(type, ValueKind::number, dim)) return;
  const std::optional<double> value = fold(id, 0);
  if (value && !range.holds(*value))
    sink_.error(node(id).span, codes::kValueRange, std::string(range.rule), std::string(range.example));
}

void Checker::footprint(StmtId id, const StmtNode& s) {
  FootprintNode& plan = program_.ast.footprints[s.extra];
  demandRange(plan.count, kRatio, "the number of pieces", kMergeRange);
  ExprId out[2] = {kNoId, kNoId};
  switch (plan.outline) {
    case Outline::rect:
      if (!bindWords(plan.args, plan.span, "rect", {"x", "z"}, 2, out)) break;
      for (ExprId edge : out) demand(edge, ValueKind::number, kLength, "an edge of a footprint");
      break;
    case Outline::regular:
      if (!bindWords(plan.args, plan.span, "regular", {"n", "r"}, 2, out)) break;
      demandRange(out[0], kRatio, "the number of corners", kCornerRange);
      demand(out[1], ValueKind::number, kLength, "the radius of a footprint");
      break;
    case Outline::polygon: {
      std::vector<uint32_t> corners;
      for (uint32_t i = 0; i < plan.args.count; ++i) {
        const ArgNode& arg = program_.ast.args[plan.args.first + i];
        demand(arg.value, ValueKind::pair, kLength, "a corner of a footprint");
        corners.push_back(arg.value);
        if (arg.name != kNoId)
          sink_.error(arg.span, codes::kArgumentName, "the corners of a polygon have no names",
                      "such as polygon((0m, 0m), (8m, 0m), (8m, 6m))");
      }
      if (corners.size() < 3 || corners.size() > 64)
        sink_.error(plan.span, codes::kArgumentCount, "a polygon has 3 to 64 corners",
                    "such as polygon((0m, 0m), (8m, 0m), (8m, 6m))");
      if (plan.count != kNoId)
        sink_.error(plan.span, codes::kWrongUse, "`merge` takes rectangles and regular polygons only",
                    "give the polygon the corners of the whole outline, or merge `rect` or `regular`");
      if (plan.bound.count == 0) plan.bound = store(corners);
      break;
    }
  }
  if (plan.outline != Outline::polygon && plan.bound.count == 0) plan.bound = store({out[0], out[1]});
  const uint32_t slot = scope_.next_slot++;
  program_.ast.stmts[id].slot = slot;
  declareLocal(s.name, s.span, {s.name, slot, {ValueKind::plan, kRatio, false, false}, kNoId, 0});
}

/// Reports an error if the plan's name is undeclared, and returns whether it is.
bool Checker::planUnknown(ExprId id) {
  const ExprNode& plan = node(id);
  const auto named = [&](const Local& local) { return local.name == plan.name; };
  if (std::any_of(scope_.locals.begin(), scope_.locals.end(), named) || symbols_[scope_.module].contains(plan.name))
    return false;
  if (mayBeLost(scope_.module, plan.name)) return true;
  const std::string_view word = text(plan.name);
  std::string hint = join({"write `footprint rect(12m, 8m) as ", word, ";` before it in the rule"});
  const StmtId body =
      override_ != kNoId ? program_.overrides[override_].body : program_.rules[rule_].alternatives[alternative_].body;
  const Span& here = program_.stmt(body).span;
  for (const StmtNode& s : program_.ast.stmts) {
    if (s.kind != StmtKind::footprint || s.name != plan.name || s.span.file != plan.span.file) continue;
    if (s.span.begin >= here.begin && s.span.end <= here.end) {
      hint = s.span.begin > plan.span.begin
                 ? "it is known after its footprint: put that first"
                 : "it is known in the block of its footprint: put that into a block around both";
      break;
    }
    hint =
        join({"pass the plan of another rule as an argument: `rule Name(", word, ") { ... }` and `Name(", word, ");`"});
  }
  Suggestion suggestion(word);
  for (const Local& local : scope_.locals)
    if (local.type.kind == ValueKind::plan) suggestion.offer(text(local.name));
  sink_.error(plan.span, codes::kUnknownName, join({"there is no plan `", word, "` here"}), suggestion.hintOr(hint));
  return true;
}

void Checker::planOf(const StmtNode& s) {
  if (s.plan == kNoId || planUnknown(s.plan)) return;
  const Type type = expression(s.plan);
  if (type.kind != ValueKind::plan && type.kind != ValueKind::unknown)
    sink_.error(node(s.plan).span, codes::kTypeMismatch,
                join({"`of` names a plan, and this is ", withArticle(typeName(type))}),
                "such as `footprint rect(12m, 8m) as plan;` before it in the rule");
}

void Checker::extrude(const StmtNode& s, bool shrunk) {
  demand(s.expr, ValueKind::number, kLength, "the height of an extrusion");
  planOf(s);
  statement(s.body, shrunk);
}

void Checker::roof(const StmtNode& s) {
  RoofNode& roof = program_.ast.roofs[s.extra];
  ExprId out[2] = {kNoId, kNoId};
  const bool flat = roof.form == RoofForm::flat;
  const std::string_view word = flat ? "flat" : roof.form == RoofForm::gable ? "gable" : "hip";
  if (bindWords(roof.args, s.span, word, {flat ? "h" : "pitch", "overhang"}, 1, out)) {
    if (flat)
      demand(out[0], ValueKind::number, kLength, "the height of a flat roof");
    else
      demandRange(out[0], kAngle, "the pitch of a roof", kPitchRange);
    demandRange(out[1], kLength, "the overhang of a roof", kOverhangRange);
    roof.measure = out[0];
    roof.overhang = out[1];
  }
  planOf(s);
}

}  // namespace sgm

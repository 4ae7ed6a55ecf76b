// Checks footprints, their extrusions, and roofs.

#include "grammar/check/arguments.h"
#include "grammar/check/leaf_statements.h"
#include "grammar/syntax/profile_limits.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// Returns true if the plan's name is undeclared. Reports an error then, unless its declaration may be in a part of the
/// text that failed to parse.
bool reportUnknownPlan(CheckContext& check, Symbols& symbols, const Scope& scope, ExprId id, StmtId body) {
  const ExprNode& plan = check.node(id);
  if (scope.hides(plan.name) || symbols.find(scope.module, plan.name) != nullptr) return false;
  if (symbols.mayBeLost(scope.module, plan.name)) return true;
  const std::string_view word = check.text(plan.name);
  std::string hint = join({"write `footprint rect(12m, 8m) as ", word, ";` before it in the rule"});
  const Span& here = check.program.stmt(body).span;
  for (const StmtNode& s : check.program.ast.stmts) {
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
  for (const Local& local : scope.locals)
    if (local.type.kind == ValueKind::plan) suggestion.offer(check.text(local.name));
  check.sink.error(plan.span, codes::kUnknownName, join({"there is no plan `", word, "` here"}),
                   suggestion.hintOr(hint));
  return true;
}

}  // namespace

void checkFootprint(CheckContext& check, Types& types, StmtId id, const StmtNode& s) {
  FootprintNode& plan = check.program.ast.footprints[s.extra];
  types.requireRange(plan.count, kRatio, "the number of pieces", kMergeRange);
  ExprId out[2] = {kNoId, kNoId};
  switch (plan.outline) {
    case Outline::rect:
      if (!bindWords(check, plan.args, plan.span, "rect", {"x", "z"}, 2, out)) break;
      for (ExprId edge : out) types.require(edge, ValueKind::number, kLength, "an edge of a footprint");
      break;
    case Outline::regular:
      if (!bindWords(check, plan.args, plan.span, "regular", {"n", "r"}, 2, out)) break;
      types.requireRange(out[0], kRatio, "the number of corners", kCornerRange);
      types.require(out[1], ValueKind::number, kLength, "the radius of a footprint");
      break;
    case Outline::polygon: {
      std::vector<uint32_t> corners;
      for (uint32_t i = 0; i < plan.args.count; ++i) {
        const ArgNode& arg = check.program.ast.args[plan.args.first + i];
        types.require(arg.value, ValueKind::pair, kLength, "a corner of a footprint");
        corners.push_back(arg.value);
        if (arg.name != kNoId)
          check.sink.error(arg.span, codes::kArgumentName, "the corners of a polygon have no names",
                           "such as polygon((0m, 0m), (8m, 0m), (8m, 6m))");
      }
      if (corners.size() < 3 || corners.size() > 64)
        check.sink.error(plan.span, codes::kArgumentCount, "a polygon has 3 to 64 corners",
                         "such as polygon((0m, 0m), (8m, 0m), (8m, 6m))");
      if (plan.count != kNoId)
        check.sink.error(plan.span, codes::kWrongUse, "`merge` takes rectangles and regular polygons only",
                         "give the polygon the corners of the whole outline, or merge `rect` or `regular`");
      if (plan.bound.count == 0) plan.bound = check.store(corners);
      break;
    }
  }
  if (plan.outline != Outline::polygon && plan.bound.count == 0) plan.bound = check.store({out[0], out[1]});
  const uint32_t slot = types.scope().next_slot++;
  check.program.ast.stmts[id].slot = slot;
  types.declareLocal(s.name, s.span, {s.name, slot, {ValueKind::plan, kRatio, false, false}, kNoId, 0});
}

void checkPlan(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s, StmtId body) {
  if (s.plan == kNoId || reportUnknownPlan(check, symbols, types.scope(), s.plan, body)) return;
  const Type type = types.checkExpression(s.plan);
  if (type.kind != ValueKind::plan && type.kind != ValueKind::unknown)
    check.sink.error(check.node(s.plan).span, codes::kTypeMismatch,
                     join({"`of` names a plan, and this is ", withArticle(typeName(type))}),
                     "such as `footprint rect(12m, 8m) as plan;` before it in the rule");
}

void checkRoof(CheckContext& check, Symbols& symbols, Types& types, const StmtNode& s, StmtId body) {
  RoofNode& roof = check.program.ast.roofs[s.extra];
  ExprId out[2] = {kNoId, kNoId};
  const bool flat = roof.form == RoofForm::flat;
  const std::string_view word = flat ? "flat" : roof.form == RoofForm::gable ? "gable" : "hip";
  if (bindWords(check, roof.args, s.span, word, {flat ? "h" : "pitch", "overhang"}, 1, out)) {
    if (flat)
      types.require(out[0], ValueKind::number, kLength, "the height of a flat roof");
    else
      types.requireRange(out[0], kAngle, "the pitch of a roof", kPitchRange);
    types.requireRange(out[1], kLength, "the overhang of a roof", kOverhangRange);
    roof.measure = out[0];
    roof.overhang = out[1];
  }
  checkPlan(check, symbols, types, s, body);
}

}  // namespace sgm

// Checks loops, scatters and details.

#include "grammar/check/arguments.h"
#include "grammar/check/statements.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

void checkArea(CheckContext& check, Types& types, ScatterNode& scatter, const Span& span) {
  ExprId out[3] = {kNoId, kNoId, kNoId};
  bool good = true;
  switch (scatter.area) {
    case ScatterArea::cell:
      break;
    case ScatterArea::shell:
      good = bindWords(check, scatter.args, span, "shell", {"r", "up"}, 1, out);
      if (good) types.require(out[0], ValueKind::number, kLength, "the radius of a shell");
      if (good) types.require(out[1], ValueKind::number, kRatio, "the upper share of a shell");
      break;
    case ScatterArea::disc:
      good = bindWords(check, scatter.args, span, "disc", {"r"}, 1, out);
      if (good) types.require(out[0], ValueKind::number, kLength, "the radius of a disc");
      break;
    case ScatterArea::box:
      good = bindWords(check, scatter.args, span, "box", {"x", "y", "z"}, scatter.args.count == 1 ? 1 : 3, out);
      if (!good) break;
      if (out[1] == kNoId && out[2] == kNoId) {
        types.require(out[0], ValueKind::vector, kLength, "the size of a box");
      } else {
        for (ExprId edge : out) types.require(edge, ValueKind::number, kLength, "an edge of a box");
      }
      break;
  }
  scatter.a = out[0];
  scatter.b = out[1];
  scatter.c = out[2];
}

}  // namespace

/// Checks a `detail`. Names declared in it must not be used after it: they have no value at levels that omit the
/// detail.
void Statements::checkDetail(const StmtNode& s, bool shrunk) {
  types_.require(s.expr, ValueKind::number, kLength, "the size of a detail");
  const size_t known = types_.scope().locals.size();
  const uint32_t before = check_.sink.errorCount();
  checkStatement(s.body, shrunk);
  if (types_.scope().locals.size() > known && check_.sink.errorCount() == before)
    check_.sink.error(s.span, codes::kWrongUse,
                      join({"`", check_.text(types_.scope().locals[known].name),
                            "` would have no value where this detail is left out"}),
                      "declare it before the detail, or within a block of the detail, with what uses it");
}

void Statements::checkLoop(StmtId id, const StmtNode& s, bool shrunk) {
  const Type source = types_.checkExpression(s.expr);
  Type type;
  if (source.kind == ValueKind::range) {
    type = {ValueKind::number, kRatio, false, false};
  } else if (source.kind == ValueKind::faces) {
    type.kind = ValueKind::face;
  } else if (source.kind == ValueKind::segments) {
    type.kind = ValueKind::segment;
  } else if (source.kind != ValueKind::unknown) {
    check_.sink.error(check_.node(s.expr).span, codes::kTypeMismatch,
                      join({"`for` goes through a range, faces or segments, and this is a ", typeName(source)}),
                      "such as 0..4, cell.links(tree 3) or branch(12, step 6m, turn 25deg)");
  }
  types_.requireDerived(s.expr, "the source of `for`");
  const uint32_t slot = types_.scope().next_slot++;
  check_.program.ast.stmts[id].slot = slot;
  const size_t locals = types_.scope().locals.size();
  types_.declareLocal(s.name, s.span, {s.name, slot, type, kNoId, 0});
  checkStatement(s.body, shrunk);
  types_.scope().closeTo(locals);
}

void Statements::checkScatter(const StmtNode& s, bool shrunk) {
  ScatterNode& points = check_.program.ast.scatters[s.extra];
  if (points.poisson)
    types_.require(points.count, ValueKind::number, kLength, "the least distance of points");
  else
    types_.require(points.count, ValueKind::number, kRatio, "a count");
  checkArea(check_, types_, points, s.span);
  if (points.probe != 0) {
    types_.require(points.distance, ValueKind::number, kLength, "the length of a probe");
    points.layer = types_.askLayer(points.layer_name, points.span, "probes");
  }
  if (points.within != kNoId) types_.require(points.within, ValueKind::number, kLength, "the limit of a gap");
  const size_t locals = types_.scope().locals.size();
  if (points.gap != kNoId) {
    const uint32_t slot = types_.scope().next_slot++;
    check_.program.ast.scatters[s.extra].slot = slot;
    types_.declareLocal(points.gap, s.span, {points.gap, slot, {ValueKind::number, kLength, false, false}, kNoId, 0});
  }
  if (points.when != kNoId) types_.require(points.when, ValueKind::boolean, kRatio, "the `when` of a scatter");
  checkStatement(s.body, shrunk);
  types_.scope().closeTo(locals);
}

}  // namespace sgm

// Transforms, loops and point sets; the targets of cuts.

#include <algorithm>

#include "grammar/check/check.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm {

/// Coarse cells skip a detail, so a name declared in it would have no value after it.
void Checker::detail(const StmtNode& s, bool shrunk) {
  demand(s.expr, ValueKind::number, kLength, "the size of a detail");
  const size_t known = scope_.locals.size();
  const uint32_t before = sink_.errorCount();
  statement(s.body, shrunk);
  if (scope_.locals.size() > known && sink_.errorCount() == before)
    sink_.error(s.span, codes::kWrongUse,
                join({"`", text(scope_.locals[known].name), "` would have no value where this detail is left out"}),
                "declare it before the detail, or within a block of the detail, with what uses it");
}

void Checker::forEach(StmtId id, const StmtNode& s, bool shrunk) {
  const Type source = expression(s.expr);
  Type type;
  if (source.kind == ValueKind::range) {
    type = {ValueKind::number, kRatio, false, false};
  } else if (source.kind == ValueKind::faces) {
    type.kind = ValueKind::face;
  } else if (source.kind == ValueKind::segments) {
    type.kind = ValueKind::segment;
  } else if (source.kind != ValueKind::unknown) {
    sink_.error(node(s.expr).span, codes::kTypeMismatch,
                join({"`for` goes through a range, faces or segments, and this is a ", typeName(source)}),
                "such as 0..4, cell.links(tree 3) or branch(12, step 6m, turn 25deg)");
  }
  deriveOnly(s.expr, "the source of `for`");
  const uint32_t slot = scope_.next_slot++;
  program_.ast.stmts[id].slot = slot;
  const size_t locals = scope_.locals.size();
  declareLocal(s.name, s.span, {s.name, slot, type, kNoId, 0});
  statement(s.body, shrunk);
  scope_.locals.resize(std::min(locals, scope_.locals.size()));
}

void Checker::scatterStatement(const StmtNode& s, bool shrunk) {
  ScatterNode& scatter = program_.ast.scatters[s.extra];
  if (scatter.poisson)
    demand(scatter.count, ValueKind::number, kLength, "the least distance of points");
  else
    demand(scatter.count, ValueKind::number, kRatio, "a count");
  ExprId out[3] = {kNoId, kNoId, kNoId};
  bool good = true;
  switch (scatter.area) {
    case ScatterArea::cell:
      break;
    case ScatterArea::shell:
      good = bindWords(scatter.args, s.span, "shell", {"r", "up"}, 1, out);
      if (good) demand(out[0], ValueKind::number, kLength, "the radius of a shell");
      if (good) demand(out[1], ValueKind::number, kRatio, "the upper share of a shell");
      break;
    case ScatterArea::disc:
      good = bindWords(scatter.args, s.span, "disc", {"r"}, 1, out);
      if (good) demand(out[0], ValueKind::number, kLength, "the radius of a disc");
      break;
    case ScatterArea::box:
      good = bindWords(scatter.args, s.span, "box", {"x", "y", "z"}, scatter.args.count == 1 ? 1 : 3, out);
      if (!good) break;
      if (out[1] == kNoId && out[2] == kNoId) {
        demand(out[0], ValueKind::vector, kLength, "the size of a box");
      } else {
        for (ExprId edge : out) demand(edge, ValueKind::number, kLength, "an edge of a box");
      }
      break;
  }
  scatter.a = out[0];
  scatter.b = out[1];
  scatter.c = out[2];
  if (scatter.probe != 0) {
    demand(scatter.distance, ValueKind::number, kLength, "the length of a probe");
    scatter.layer = layerBelow(scatter.layer_name, scatter.span, "probes");
  }
  if (scatter.within != kNoId) demand(scatter.within, ValueKind::number, kLength, "the limit of a gap");
  const size_t locals = scope_.locals.size();
  if (scatter.gap != kNoId) {
    const uint32_t slot = scope_.next_slot++;
    program_.ast.scatters[s.extra].slot = slot;
    declareLocal(scatter.gap, s.span, {scatter.gap, slot, {ValueKind::number, kLength, false, false}, kNoId, 0});
  }
  if (scatter.when != kNoId) demand(scatter.when, ValueKind::boolean, kRatio, "the `when` of a scatter");
  statement(s.body, shrunk);
  scope_.locals.resize(std::min(locals, scope_.locals.size()));
}

/// Reports an error if the axis name is undeclared, and returns whether it is.
bool Checker::unknownAxis(ExprId axis) {
  const NameId name = node(axis).name;
  const auto named = [name](const Local& local) { return local.name == name; };
  if (isValueWord(text(name)) || symbols_[scope_.module].contains(name) ||
      std::any_of(scope_.locals.begin(), scope_.locals.end(), named) || mayBeLost(scope_.module, name))
    return false;
  sink_.error(node(axis).span, codes::kUnknownName,
              join({"the axis of `rot` is x, y, z or a vector, and `", text(name), "` is none of these"}),
              "such as rot(y, 30deg)");
  return true;
}

bool Checker::xforms(IdRange range, bool copied) {
  bool shrinks = false;
  for (uint32_t i = 0; i < range.count; ++i) {
    XformNode& x = program_.ast.xforms[range.first + i];
    ExprId out[3] = {kNoId, kNoId, kNoId};
    auto axisOf = [&](ExprId id) -> uint8_t {
      const std::string_view word = node(id).kind == ExprKind::name ? text(node(id).name) : std::string_view();
      // A number with that name, such as the width x of a board, is not an axis and hides none.
      const auto vector = [&](const Local& local) {
        return text(local.name) == word && local.type.kind == ValueKind::vector;
      };
      const bool hidden = x.kind == XformKind::rot && std::any_of(scope_.locals.begin(), scope_.locals.end(), vector);
      if (hidden) return 3;
      return word == "x" ? 0 : word == "y" ? 1 : word == "z" ? 2 : 3;
    };
    switch (x.kind) {
      case XformKind::at:
      case XformKind::size: {
        const bool at = x.kind == XformKind::at;
        shrinks = shrinks || !at;  // the proof of reach finds scopes that do not shrink after all
        if (!bindWords(x.args, x.span, at ? "at" : "size", {"x", "y", "z"}, 1, out)) break;
        const bool alone = x.args.count == 1 && program_.ast.args[x.args.first].name == kNoId;
        if (alone) {
          demand(out[0], ValueKind::vector, kLength, at ? "the vector of `at`" : "the vector of `size`");
        } else {
          for (ExprId part : out)
            demand(part, ValueKind::number, kLength, at ? "a coordinate of `at`" : "an edge of `size`");
        }
        break;
      }
      case XformKind::rot:
        if (!bindWords(x.args, x.span, "rot", {"axis", "angle"}, 2, out)) break;
        x.axis = axisOf(out[0]);
        if (x.axis == 3) {
          if (node(out[0]).kind == ExprKind::name && unknownAxis(out[0])) break;
          const Type axis = expression(out[0]);
          if (axis.kind != ValueKind::vector && axis.kind != ValueKind::unknown)
            sink_.error(node(out[0]).span, codes::kTypeMismatch, "the axis of `rot` is x, y, z or a vector",
                        "such as rot(y, 30deg)");
          deriveOnly(out[0], "an axis");
        }
        demand(out[1], ValueKind::number, kAngle, "the angle of `rot`");
        break;
      case XformKind::scale:
        if (x.args.count > 1) {
          sink_.error(x.span, codes::kArgumentCount, "`scale` takes one factor",
                      "a distance cannot be stretched unevenly; give the shape its sizes instead");
          break;
        }
        if (bindWords(x.args, x.span, "scale", {"factor"}, 1, out))
          demand(out[0], ValueKind::number, kRatio, "the factor of `scale`");
        if (out[0] != kNoId) scales_.push_back({out[0], copied});
        break;
      case XformKind::mirror:
        if (!bindWords(x.args, x.span, "mirror", {"axis"}, 1, out)) break;
        x.axis = axisOf(out[0]);
        if (x.axis == 3)
          sink_.error(node(out[0]).span, codes::kTypeMismatch, "the axis of `mirror` is x, y or z",
                      "such as mirror(x)");
        break;
    }
    x.a = out[0];
    x.b = out[1];
    x.c = out[2];
  }
  return shrinks;
}

/// A cut directly at the level of a layer's start rule cuts from the domain.
void Checker::markLayerLevel(StmtId id) {
  StmtNode& s = program_.ast.stmts[program_.innermost(id)];
  if (s.kind == StmtKind::cut || s.kind == StmtKind::inner) s.layer_level = true;
  if (s.kind != StmtKind::block) return;
  if (const IdRange edits = program_.overridesOf(s.tag); edits.count > 0)
    markOverrides(edits, cutsDomain(program_.innermost(id)));
  for (uint32_t i = 0; i < s.children.count; ++i) markLayerLevel(program_.idAt(s.children, i));
}

/// For a block after other content, to which its statements add.
void Checker::idleCutsIn(StmtId block) {
  const IdRange children = program_.stmt(block).children;
  for (uint32_t i = 0; i < children.count; ++i) idleCuts(program_.idAt(children, i), false);
}

/// A cut removes from the content before it in its block; without any it has no effect. `first`: the block to which
/// this statement adds is still empty.
void Checker::idleCuts(StmtId id, bool first) {
  if (id == kNoId || sink_.full()) return;
  const StmtNode& s = program_.stmt(id);
  if (placesBody(s.kind)) return idleCuts(s.body, first);
  switch (s.kind) {
    case StmtKind::cut:
      if (first && !s.layer_level)
        sink_.warning(s.span, codes::kIdleCut, "nothing stands before this cut in its block",
                      "a cut takes from what its own block has added before it");
      return idleCuts(s.body, true);
    case StmtKind::block: {
      bool nothing = true;
      for (uint32_t i = 0; i < s.children.count; ++i) {
        const StmtId child = program_.idAt(s.children, i);
        idleCuts(child, nothing);
        const StmtKind kind = program_.stmt(program_.innermost(child)).kind;
        nothing = nothing &&
                  (kind == StmtKind::cut || kind == StmtKind::let || kind == StmtKind::field || kind == StmtKind::mat ||
                   kind == StmtKind::tag || kind == StmtKind::anchor || kind == StmtKind::footprint);
      }
      return;
    }
    case StmtKind::extrude:
      // The piece itself comes before them.
      if (s.body != kNoId) idleCutsIn(s.body);
      return;
    case StmtKind::treemap:
      // Rooms and corridors come before the content of their blocks.
      for (uint32_t i = 0; i < s.children.count; ++i) {
        const StmtId child = program_.idAt(s.children, i);
        const bool open = program_.ast.parts[s.parts.first + i].floor != FloorPart::facade;
        if (!open || program_.stmt(child).kind != StmtKind::block) {
          idleCuts(child, !open);
          continue;
        }
        idleCutsIn(child);
      }
      return;
    case StmtKind::morph:
    case StmtKind::split:
    case StmtKind::comp:
    case StmtKind::wfc:
      for (uint32_t i = 0; i < s.children.count; ++i) idleCuts(program_.idAt(s.children, i), true);
      return;
    default:
      return idleCuts(s.body, true);
  }
}

}  // namespace sgm

// Transforms of the scope: at, rot, scale, size and mirror.

#include <algorithm>

#include "grammar/check/arguments.h"
#include "grammar/check/leaf_statements.h"
#include "grammar/syntax/keywords.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

/// Returns 0, 1 or 2 if the expression is an axis name x, y or z, and 3 if it is another expression. In `rot`, a local
/// vector named x, y or z takes precedence over the axis; a local number of that name does not.
uint8_t axisOf(const CheckContext& check, const Scope& scope, XformKind kind, ExprId id) {
  const std::string_view word =
      check.node(id).kind == ExprKind::name ? check.text(check.node(id).name) : std::string_view();
  const bool hidden = kind == XformKind::rot && std::ranges::any_of(scope.locals, [&](const Local& local) {
                        return check.text(local.name) == word && local.type.kind == ValueKind::vector;
                      });
  if (hidden) return 3;
  return word == "x" ? 0 : word == "y" ? 1 : word == "z" ? 2 : 3;
}

/// Returns true, after reporting an error, if the axis name is undeclared. If its declaration may be in a part of the
/// text that failed to parse, reports nothing and returns false.
bool reportUnknownAxis(CheckContext& check, Symbols& symbols, const Scope& scope, ExprId axis) {
  const NameId name = check.node(axis).name;
  if (isValueWord(check.text(name)) || symbols.find(scope.module, name) != nullptr || scope.hides(name) ||
      symbols.mayBeLost(scope.module, name))
    return false;
  check.sink.error(check.node(axis).span, codes::kUnknownName,
                   join({"the axis of `rot` is x, y, z or a vector, and `", check.text(name), "` is none of these"}),
                   "such as rot(y, 30deg)");
  return true;
}

}  // namespace

TransformEffect checkTransforms(CheckContext& check, Symbols& symbols, Types& types, IdRange xforms) {
  TransformEffect effect;
  for (uint32_t i = 0; i < xforms.count; ++i) {
    XformNode& x = check.program.ast.xforms[xforms.first + i];
    ExprId out[3] = {kNoId, kNoId, kNoId};
    switch (x.kind) {
      case XformKind::at:
      case XformKind::size: {
        const bool at = x.kind == XformKind::at;
        effect.shrinks = effect.shrinks || !at;
        if (!bindWords(check, x.args, x.span, at ? "at" : "size", {"x", "y", "z"}, 1, out)) break;
        const bool alone = x.args.count == 1 && check.program.ast.args[x.args.first].name == kNoId;
        if (alone) {
          types.require(out[0], ValueKind::vector, kLength, at ? "the vector of `at`" : "the vector of `size`");
        } else {
          for (ExprId part : out)
            types.require(part, ValueKind::number, kLength, at ? "a coordinate of `at`" : "an edge of `size`");
        }
        break;
      }
      case XformKind::rot:
        if (!bindWords(check, x.args, x.span, "rot", {"axis", "angle"}, 2, out)) break;
        x.axis = axisOf(check, types.scope(), x.kind, out[0]);
        if (x.axis == 3) {
          if (check.node(out[0]).kind == ExprKind::name && reportUnknownAxis(check, symbols, types.scope(), out[0]))
            break;
          const Type axis = types.checkExpression(out[0]);
          if (axis.kind != ValueKind::vector && axis.kind != ValueKind::unknown)
            check.sink.error(check.node(out[0]).span, codes::kTypeMismatch, "the axis of `rot` is x, y, z or a vector",
                             "such as rot(y, 30deg)");
          types.requireDerived(out[0], "an axis");
        }
        types.require(out[1], ValueKind::number, kAngle, "the angle of `rot`");
        break;
      case XformKind::scale:
        if (x.args.count > 1) {
          check.sink.error(x.span, codes::kArgumentCount, "`scale` takes one factor",
                           "a distance cannot be stretched unevenly; give the shape its sizes instead");
          break;
        }
        if (bindWords(check, x.args, x.span, "scale", {"factor"}, 1, out))
          types.require(out[0], ValueKind::number, kRatio, "the factor of `scale`");
        if (out[0] != kNoId) effect.factors.push_back(out[0]);
        break;
      case XformKind::mirror:
        if (!bindWords(check, x.args, x.span, "mirror", {"axis"}, 1, out)) break;
        x.axis = axisOf(check, types.scope(), x.kind, out[0]);
        if (x.axis == 3)
          check.sink.error(check.node(out[0]).span, codes::kTypeMismatch, "the axis of `mirror` is x, y or z",
                           "such as mirror(x)");
        break;
    }
    x.a = out[0];
    x.b = out[1];
    x.c = out[2];
  }
  return effect;
}

}  // namespace sgm

#include "grammar/check/declared_constants.h"

#include <cmath>

#include "grammar/text/codes.h"

namespace sgm {

namespace {

struct Ends {
  double low = 0, high = 0;
};

/// Evaluates the ends of a range; nullopt after reporting an error.
std::optional<Ends> endsOf(CheckContext& check, Types& types, ExprId low_expr, ExprId high_expr, Dim dim) {
  const auto low = checkConstant(check, types, low_expr, dim, "the low end of a range");
  const auto high = checkConstant(check, types, high_expr, dim, "the high end of a range");
  if (!low || !high) return std::nullopt;
  if (*low <= *high) return Ends{*low, *high};
  check.sink.error(check.node(low_expr).span, codes::kParamRange, "the range is reversed", "write its low end first");
  return std::nullopt;
}

/// Requires that a default value lies within its range. Returns false after reporting an error.
bool checkDefault(CheckContext& check, const Ends& range, ExprId value_expr, double value, Dim dim, NameId name) {
  if (value >= range.low && value <= range.high) return true;
  const bool percent = dim == kRatio && range.high <= 1 && value / 100 >= range.low && value / 100 <= range.high;
  check.sink.error(
      check.node(value_expr).span, codes::kParamRange,
      join({"the default of `", check.text(name), "` lies outside of its range"}),
      percent ? join({"write ", numberText(value), "%"}) : "widen the range, or choose a default within it");
  return false;
}

}  // namespace

std::optional<double> checkConstant(CheckContext& check, Types& types, ExprId id, Dim dim, std::string_view what) {
  const uint32_t before = check.sink.errorCount();
  types.enter({});
  const Type type = types.require(id, ValueKind::number, dim, what);
  if (check.sink.errorCount() > before || type.kind == ValueKind::unknown) return std::nullopt;
  const auto value = types.fold(id);
  if (!value || !std::isfinite(*value)) {
    check.sink.error(check.node(id).span, codes::kNotConstant, join({what, " must be a constant"}),
                     "use numbers, arithmetic and lets without parameters");
    return std::nullopt;
  }
  return value;
}

std::optional<int64_t> checkWholeUnits(CheckContext& check, Types& types, ExprId id, std::string_view what) {
  const auto metres = checkConstant(check, types, id, kLength, what);
  if (!metres) return std::nullopt;
  const double units = *metres * kUnitsPerMetre, whole = std::floor(units + 0.5);
  if (std::fabs(units - whole) > 1e-6) {
    check.sink.error(check.node(id).span, codes::kWholeUnits, join({what, " is a whole number of units of 1/1024 m"}),
                     join({"the nearest is ", numberText(whole / kUnitsPerMetre), "m"}));
    return std::nullopt;
  }
  return static_cast<int64_t>(whole);
}

void checkFormalLiterals(CheckContext& check) {
  for (const FormalNode& formal : check.program.ast.formals) {
    if (formal.fallback != kNoId && !isLiteral(check.program, formal.fallback))
      check.sink.error(check.node(formal.fallback).span, codes::kNotConstant, "a default is made of numbers alone",
                       "such as r = 2m or r = 3*0.5m");
    for (const ExprId end : {formal.low_expr, formal.high_expr})
      if (end != kNoId && !isLiteral(check.program, end))
        check.sink.error(check.node(end).span, codes::kNotConstant, "the range of a parameter is made of numbers alone",
                         "such as r in 1m..60m");
  }
}

void checkFormalRanges(CheckContext& check, Types& types) {
  for (size_t i = 0; i < check.program.ast.formals.size(); ++i) {
    FormalNode& formal = check.program.ast.formals[i];
    if (formal.low_expr == kNoId || formal.high_expr == kNoId) continue;
    types.enter({});
    const Type low = types.checkExpression(formal.low_expr), high = types.checkExpression(formal.high_expr);
    formal.dim = low.any_dim ? high.dim : low.dim;
    const auto range = endsOf(check, types, formal.low_expr, formal.high_expr, formal.dim);
    if (!range) continue;
    if (formal.fallback != kNoId) {
      const auto value = checkConstant(check, types, formal.fallback, formal.dim, "the default of a parameter");
      if (!value || !checkDefault(check, *range, formal.fallback, *value, formal.dim, formal.name)) continue;
    }
    formal.ranged = true;
    formal.low = range->low;
    formal.high = range->high;
  }
}

void checkParams(CheckContext& check, Types& types) {
  for (Param& param : check.program.params) {
    if (param.module != 0) continue;
    types.enter({});
    const Type type = types.checkExpression(param.value_expr);
    if (type.kind == ValueKind::unknown) continue;
    if (type.kind != ValueKind::number) {
      check.sink.error(check.node(param.value_expr).span, codes::kTypeMismatch,
                       join({"a parameter is a number, and this is a ", typeName(type)}), "such as param a = 2m;");
      continue;
    }
    param.dim = type.dim;
    if (type.any_dim && param.has_range) {
      const Type low = types.checkExpression(param.low_expr), high = types.checkExpression(param.high_expr);
      param.dim = low.any_dim ? high.dim : low.dim;
    }
    const auto value = checkConstant(check, types, param.value_expr, param.dim, "the default of a parameter");
    if (!value) continue;
    param.value = param.low = param.high = *value;
    if (param.animated && !param.has_range) {
      check.sink.error(param.span, codes::kParamRange,
                       join({"`", check.text(param.name), "` is animated and has no range"}),
                       join({"write its range: `param ", check.text(param.name), " = ... in LOW..HIGH animated`"}));
      continue;
    }
    if (param.has_range) {
      const auto range = endsOf(check, types, param.low_expr, param.high_expr, param.dim);
      if (!range || !checkDefault(check, *range, param.value_expr, *value, param.dim, param.name)) continue;
      param.low = range->low;
      param.high = range->high;
    }
    auto written_whole = [&](ExprId id) {
      return id == kNoId ||
             (check.node(id).kind == ExprKind::number && check.node(id).value == std::floor(check.node(id).value) &&
              check.text(check.node(id).name).find_first_not_of("0123456789") == std::string_view::npos);
    };
    param.whole = param.dim == kRatio && written_whole(param.value_expr) && written_whole(param.low_expr) &&
                  written_whole(param.high_expr) && !(param.has_range && param.low == 0 && param.high == 1);
  }
}

}  // namespace sgm

// Compares arguments of rules, lets and fields with the declared ranges, if the range of the argument is known.

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/math.h"
#include "grammar/range/argument_ranges.h"
#include "grammar/range/reach_values.h"
#include "grammar/text/codes.h"
#include "grammar/text/limits.h"

namespace sgm {

namespace {

/// relative tolerance of comparisons with a range, because interval arithmetic widens the possible values slightly
constexpr double kWidening = 1e-9;

/// A unit as written after a number.
struct Unit {
  std::string_view name;
  Dim dim;
  double value;
};

/// All units that a number can be written with. If the two ends of a range have different units, messages show the
/// range in the first unit listed here for their dimension.
constexpr Unit kUnits[] = {{"m", kLength, 1},     {"cm", kLength, 0.01},      {"mm", kLength, 0.001},
                           {"km", kLength, 1000}, {"deg", kAngle, kPi / 180}, {"rad", kAngle, 1},
                           {"m2", kArea, 1},      {"m3", kVolume, 1},         {"", kRatio, 1},
                           {"%", kRatio, 0.01}};

std::string_view sourceText(const Program& program, ExprId id) {
  const Span& span = program.expr(id).span;
  return std::string_view(program.modules[span.file].text).substr(span.begin, span.end - span.begin);
}

/// Returns the unit in the text of a number: the part behind the digits.
std::string_view unitName(std::string_view number) {
  return number.substr(std::min(number.find_last_of("0123456789.)") + 1, number.size()));
}

/// Returns the unit of both ends of a range, if they have the same unit in the text; otherwise the first unit of their
/// dimension.
Unit unitOf(const Program& program, const FormalNode& formal) {
  const std::string_view name = unitName(sourceText(program, formal.high_expr));
  const bool both = unitName(sourceText(program, formal.low_expr)) == name;
  const Unit* first = nullptr;
  for (const Unit& unit : kUnits) {
    if (unit.dim != formal.dim) continue;
    if (both && unit.name == name) return unit;
    if (first == nullptr) first = &unit;
  }
  return first != nullptr ? *first : Unit{"", formal.dim, 1};
}

/// Formats a value for the message that it is outside of the range. It has six digits, or more if rounding to six
/// digits would bring it into the range.
std::string valueText(double value, const FormalNode& formal, const Unit& unit) {
  const double exact = value / unit.value;
  char digits[40];
  const auto end = std::to_chars(digits, digits + sizeof digits, exact, std::chars_format::general, 6).ptr;
  double rounded = exact;
  std::from_chars(digits, end, rounded);
  const bool moved_in = rounded * unit.value >= formal.low && rounded * unit.value <= formal.high &&
                        !(value >= formal.low && value <= formal.high);
  return join({numberText(moved_in ? exact : rounded), unit.name});
}

std::string intervalText(Interval given, const FormalNode& formal, const Unit& unit) {
  const auto text = [&](double value) { return valueText(value, formal, unit); };
  if (text(given.lo) == text(given.hi)) return text(given.lo);
  if (std::isinf(given.lo)) return join({text(given.hi), " or less"});
  if (std::isinf(given.hi)) return join({text(given.lo), " or more"});
  return join({text(given.lo), "..", text(given.hi)});
}

/// Returns the callee as written in the call: "`karst.Hall`".
std::string calleeName(const Program& program, const ExprNode& call) {
  if (call.qualifier == kNoId) return join({"`", program.text(call.name), "`"});
  return join({"`", program.text(call.qualifier), ".", program.text(call.name), "`"});
}

void report(const Program& program, const Misfit& misfit, DiagnosticSink& sink) {
  const FormalNode& formal = program.ast.formals[misfit.formal];
  const ExprNode& call = program.expr(misfit.call);
  const Unit unit = unitOf(program, formal);
  const std::string given = intervalText(misfit.given, formal, unit);
  const std::string low(sourceText(program, formal.low_expr)), high(sourceText(program, formal.high_expr));
  const std::string argument = join({"`", program.text(formal.name), "` = ", given});
  const bool several = given != valueText(misfit.given.lo, formal, unit);
  const std::string outside =
      join({several ? ", none of which is within " : ", which is not within ", low, "..", high});
  if (misfit.caller != kNoId) {
    const ExprNode& caller = program.expr(misfit.caller);
    sink.error(
            caller.span, codes::kArgumentRange,
            join({calleeName(program, caller), " gives ", calleeName(program, call), " ", argument, " here", outside}),
            "give it other arguments, or a scope of another size")
        .notes.push_back(join({"the call is at ", sink.place(call.span)}));
    return;
  }
  const Span& span = program.expr(misfit.argument).span;
  if (misfit.certain) {
    sink.error(span, codes::kArgumentRange, join({calleeName(program, call), " is given ", argument, outside}),
               join({"give it ", withArticle(dimName(formal.dim)), " from ", low, " to ", high}));
    return;
  }
  sink.warning(
      span, codes::kArgumentRange,
      join({calleeName(program, call), " may be given ", argument, ", not all of which is within ", low, "..", high}),
      join({"bound what it depends on, or write clamp(..., ", low, ", ", high, ")"}));
}

}  // namespace

void Misfits::compare(const Program& program, ExprId id, IdRange formals, std::span<const RangeValue> given,
                      const CallPath& calls) {
  constexpr size_t kMaxMisfits = 256;
  const ExprNode& call = program.expr(id);
  if (!compares_ || call.circular) return;
  for (uint32_t i = 0; i < formals.count && i < given.size(); ++i) {
    const FormalNode& formal = program.ast.formals[formals.first + i];
    const ExprId argument = program.idAt(call.bound, i);
    if (!formal.ranged || argument == formal.fallback || given[i].kind != ValueKind::number) continue;
    const Interval value = given[i].v[0];
    const double low = formal.low - kWidening * std::fabs(formal.low),
                 high = formal.high + kWidening * std::fabs(formal.high);
    const bool certain = value.hi < low || value.lo > high;
    const ExprId caller = calls.writtenCaller(id);
    const std::pair key(argument, caller);
    if (loose_ > 0 && !certain) loosely_fitting_.insert(key);
    if (value.lo >= low && value.hi <= high) continue;
    // Report an argument only if it is certainly outside of its range, or possibly outside with known bounds. Do not
    // report a possible violation if the bounds are overestimated, or if the call is in the standard library, where the
    // author cannot limit the argument.
    if (!certain && (loose_ > 0 || !value.bounded() || caller != kNoId)) continue;
    const Misfit misfit{argument, id, caller, formals.first + i, value, certain, loose_ > 0};
    const auto known = std::find_if(misfits_.begin(), misfits_.end(),
                                    [&](const Misfit& m) { return std::pair(m.argument, m.caller) == key; });
    if (known == misfits_.end()) {
      if (misfits_.size() < kMaxMisfits) misfits_.push_back(misfit);
    } else if (known->loose && misfit.loose) {
      known->given = hull(known->given, value);
    } else if (known->loose || (certain && !known->certain)) {
      *known = misfit;
    }
  }
}

std::vector<Misfit> Misfits::take() {
  std::vector<Misfit> out;
  std::set<ExprId> callers;
  for (const Misfit& misfit : misfits_) {
    if (misfit.loose && loosely_fitting_.contains({misfit.argument, misfit.caller})) continue;
    // A call into the standard library may cause several misfits inside the library. They have a common cause, the
    // arguments of that call, so only the first one is reported.
    if (misfit.caller == kNoId || callers.insert(misfit.caller).second) out.push_back(misfit);
  }
  misfits_.clear();
  loosely_fitting_.clear();
  return out;
}

void reportMisfits(const Program& program, std::span<const Misfit> misfits, DiagnosticSink& sink) {
  for (const Misfit& misfit : misfits) report(program, misfit, sink);
}

void checkRanges(const Program& program, const CompileLimits& limits, DiagnosticSink& sink) {
  uint32_t steps = limits.bound_steps;
  RangeEvaluator values(program, steps);
  RangeFrame anywhere;
  anywhere.scope.fill(Interval::everything());
  values.setCell(anywhere.scope, false);
  values.misfits().enable(true);
  for (uint32_t id = 0; id < program.ast.exprs.size(); ++id) {
    const ExprNode& call = program.expr(id);
    if (call.bound.count == 0 || isStandard(program, call.span.file)) continue;
    IdRange formals;
    if (call.ref == Ref::rule)
      formals = program.rules[call.id].alternatives[0].formals;
    else if (call.ref == Ref::let)
      formals = program.lets[call.id].formals;
    else if (call.ref == Ref::field)
      formals = program.fields[call.id].formals;
    std::vector<RangeValue> given;
    for (uint32_t i = 0; i < formals.count && i < call.bound.count; ++i)
      given.push_back(program.ast.formals[formals.first + i].ranged
                          ? values.evaluate(program.idAt(call.bound, i), anywhere)
                          : RangeValue::unknown());
    values.compareArguments(id, formals, given);
  }
  reportMisfits(program, values.misfits().take(), sink);
}

}  // namespace sgm

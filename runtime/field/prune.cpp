#include "field/prune.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace sgm {

namespace {

enum Choice : uint8_t { kBoth, kFirst, kSecond };

bool readsPosition(Op op) {
  switch (op) {
#define SGM_FORM_CONSTANT 0
#define SGM_FORM_POSITION 1
#define SGM_FORM_POSITION_1 1
#define SGM_FORM_UNARY 0
#define SGM_FORM_UNARY_P 0
#define SGM_FORM_BINARY 0
#define SGM_FORM_TERNARY 0
#define SGM_FORM_COPY 0
#define SGM_FORM_ROUND_BEGIN 0
#define SGM_FORM_ROUND_ADD 0
#define SGM_FORM_ROUND_END 0
#define SGM_FORM_SUM_BEGIN 0
#define SGM_FORM_SUM_ADD 0
#define SGM_FORM_SUM_END 0
#define SGM_FORM_WARP 0
#define SGM_OP(name, function, form, error) \
  case Op::name:                            \
    return SGM_FORM_##form;
#include "field/ops.def"
#undef SGM_OP
    case Op::count:
      break;
  }
  return false;
}

uint32_t operandMask(const Instr& in) {
  const uint32_t a = 1u << in.a, b = 1u << in.b, c = 1u << in.c;
  switch (in.op) {
#undef SGM_FORM_CONSTANT
#undef SGM_FORM_POSITION
#undef SGM_FORM_POSITION_1
#undef SGM_FORM_UNARY
#undef SGM_FORM_UNARY_P
#undef SGM_FORM_BINARY
#undef SGM_FORM_TERNARY
#undef SGM_FORM_COPY
#undef SGM_FORM_ROUND_BEGIN
#undef SGM_FORM_ROUND_ADD
#undef SGM_FORM_ROUND_END
#undef SGM_FORM_SUM_BEGIN
#undef SGM_FORM_SUM_ADD
#undef SGM_FORM_SUM_END
#undef SGM_FORM_WARP
#define SGM_FORM_CONSTANT 0
#define SGM_FORM_POSITION 0
#define SGM_FORM_POSITION_1 a
#define SGM_FORM_UNARY a
#define SGM_FORM_UNARY_P a
#define SGM_FORM_BINARY a | b
#define SGM_FORM_TERNARY a | b | c
#define SGM_FORM_COPY a
#define SGM_FORM_ROUND_BEGIN 0
#define SGM_FORM_ROUND_ADD a | b | 1u << in.dst
#define SGM_FORM_ROUND_END a | b
#define SGM_FORM_SUM_BEGIN 0
#define SGM_FORM_SUM_ADD a | b | 1u << in.dst
#define SGM_FORM_SUM_END a | b
#define SGM_FORM_WARP a | b | c
#define SGM_OP(name, function, form, error) \
  case Op::name:                            \
    return SGM_FORM_##form;
#include "field/ops.def"
#undef SGM_OP
    case Op::count:
      break;
  }
  return 0;
}

// Bounds of one group's result; a mark by instr for the way back: the choice of a min, max, cut or morph in lo, and the
// bounds of the operand of an accumulation.
Interval boundGroup(const ProgramView& program, const ProgramGroup& g, const PlaceBox& box, Interval* marks) {
  std::array<Interval, kMaxRegisters> r;
  std::array<PlaceBox, kMaxPlaces> places;
  places[0] = box;
  for (uint32_t i = 0; i < g.count; ++i) {
    const Instr& in = program.instrs[g.first + i];
    const uint32_t* params = program.params.data() + in.params;
    const Interval a = r[in.a], b = r[in.b], c = r[in.c];
    Choice choice = kBoth;
    switch (in.op) {
      case Op::round_begin:
        r[in.dst] = {double{kFar}, double{kFar}};
        r[in.b] = {0, 0};
        break;
      case Op::round_add: {
        const Interval share = boundRoundShare(params, a);
        marks[i] = a;
        r[in.dst] = {std::min(r[in.dst].lo, a.lo), std::min(r[in.dst].hi, a.hi)};
        const double hi = b.hi + share.hi;
        r[in.b] = {std::max(0.0, (b.lo + share.lo) * (1 - 1e-6)), hi * (1 + 1e-6)};
        continue;
      }
      case Op::round_end:
        marks[i] = a;
        r[in.dst] = boundRoundEnd(params, a, b);
        continue;
      case Op::sum_begin:
        r[in.dst] = {0, 0};
        r[in.b] = {0, 0};
        break;
      case Op::sum_add:
        marks[i] = a;
        r[in.dst] = {std::max(r[in.dst].lo, a.lo), std::max(r[in.dst].hi, a.hi)};
        r[in.b] = {(b.lo + a.lo) * (1 - 1e-6), (b.hi + a.hi) * (1 + 1e-6)};
        continue;
      case Op::sum_end:
        r[in.dst] = boundSumEnd(params, b);
        break;
      case Op::warp: {
        auto moved = [](Interval v, Interval w) {
          // A place that could wrap around the world's end may be anywhere.
          auto held = [](double x) { return std::clamp(x, -1048576.0, 1048576.0) * 1024; };
          const Interval m{v.lo + held(w.lo) - 1, v.hi + held(w.hi) + 1};
          if (m.lo < -2147483648.0 || m.hi > 2147483647.0) return Interval{-2147483648.0, 2147483647.0};
          return m;
        };
        const PlaceBox& from = places[in.place];
        places[in.dst] = {moved(from.x, a), moved(from.y, b), moved(from.z, c)};
        break;
      }
      default:
        if (in.op == Op::minimum) {
          choice = b.lo > a.hi ? kFirst : a.lo > b.hi ? kSecond : kBoth;
        } else if (in.op == Op::maximum) {
          choice = a.lo > b.hi ? kFirst : b.lo > a.hi ? kSecond : kBoth;
        } else if (in.op == Op::cut) {
          choice = a.lo > -b.lo ? kFirst : kBoth;
        } else if (in.op == Op::morph) {
          choice = c.hi <= 0 ? kFirst : c.lo >= 1 ? kSecond : kBoth;
        }
        r[in.dst] = choice == kFirst       ? a
                    : choice == kSecond    ? b
                    : readsPosition(in.op) ? boundPosition(in.op, params, places[in.place], a)
                                           : boundOperands(in.op, params, a, b, c);
        break;
    }
    marks[i] = {static_cast<double>(choice), 0};
  }
  return r[g.result];
}

// Walks a group backwards and keeps what its result needs.
void keepGroup(const ProgramView& program, const ProgramGroup& g, const Interval* marks, bool guarded,
               std::pmr::vector<Instr>& reversed, PrunedProgram& out) {
  reversed.clear();
  uint32_t live = 1u << g.result, live_places = 0;
  std::array<double, kMaxRegisters> nearest_hi{};
  for (uint32_t i = g.count; i-- > 0;) {
    Instr in = program.instrs[g.first + i];
    const uint32_t dst = 1u << in.dst;
    switch (in.op) {
      case Op::warp:
        if (!(live_places & dst)) continue;
        live_places &= ~dst;
        live |= operandMask(in);
        live_places |= 1u << in.place;
        reversed.push_back(in);
        continue;
      case Op::round_add:
      case Op::sum_add: {
        if (!(live & dst)) continue;
        const Interval d = marks[i];
        if (in.op == Op::sum_add) {
          if (d.hi <= 0) continue;
        } else {
          const double k = double{std::bit_cast<float>(program.params[in.params])};
          if (d.lo >= k && d.lo > nearest_hi[in.dst]) continue;
        }
        live |= operandMask(in);
        reversed.push_back(in);
        continue;
      }
      case Op::round_begin:
      case Op::sum_begin:
        if (!(live & dst)) continue;
        live &= ~(dst | 1u << in.b);
        reversed.push_back(in);
        continue;
      default:
        break;
    }
    if (!(live & dst)) continue;
    live &= ~dst;
    if (in.op == Op::round_end) {
      nearest_hi[in.a] = marks[i].hi;
    } else if (in.op == Op::minimum || in.op == Op::maximum || in.op == Op::cut || in.op == Op::morph) {
      const auto choice = static_cast<Choice>(static_cast<int>(marks[i].lo));
      if (choice != kBoth) {
        const uint8_t from = choice == kFirst ? in.a : in.b;
        live |= 1u << from;
        if (from != in.dst) {
          in = Instr{Op::copy, in.dst, from, 0, 0, in.place, 0, 0};
          reversed.push_back(in);
        }
        continue;
      }
    }
    live |= operandMask(in);
    if (readsPosition(in.op)) live_places |= 1u << in.place;
    reversed.push_back(in);
  }
  ProgramGroup kept = g;
  kept.first = static_cast<uint32_t>(out.instrs.size());
  kept.count = static_cast<uint32_t>(reversed.size());
  kept.guarded = guarded;
  out.instrs.insert(out.instrs.end(), reversed.rbegin(), reversed.rend());
  out.groups.push_back(kept);
}

// Folds a smooth group into the field's bounds. Where it is k away and no nearer than the field, the field keeps its
// bits; where the field is, the group takes its place.
bool foldSmooth(const ProgramGroup& g, PruneScratch::GroupBounds& b, Interval& field) {
  const double k = double{g.smooth};
  const Interval under = field, distance = g.cut ? Interval{-under.hi, -under.lo} : under;
  b.live = b.met && !(b.value.lo >= k && b.value.lo >= distance.hi);
  if (!b.live) return false;
  field = g.cut ? boundRoundCut(under, b.value, k) : boundRoundUnion(under, b.value, k);
  if (!b.whole) field = {std::min(field.lo, under.lo), std::max(field.hi, under.hi)};
  return !g.cut && b.whole && under.lo >= k && under.lo > b.value.hi;
}

}  // namespace

void prune(const ProgramView& program, const IntBox& box, PruneScratch& scratch, PrunedProgram& out) {
  out.instrs.clear();
  out.groups.clear();
  out.params = program.params;
  out.initial = program.initial;
  out.initial_label = program.initial_label;
  out.q_scale = program.q_scale;

  const PlaceBox places = placeBox(box);
  const size_t groups = program.groups.size();
  scratch.marks.resize(program.instrs.size());
  scratch.bounds.resize(groups);
  Interval field{double{program.initial}, double{program.initial}};

  auto bound = [&](size_t i) -> PruneScratch::GroupBounds& {
    const ProgramGroup& g = program.groups[i];
    auto& b = scratch.bounds[i];
    b.met = !g.guarded || g.influence.meets(box);
    b.whole = !g.guarded || g.influence.contains(box);
    b.live = b.met;
    if (b.met) b.value = boundGroup(program, g, places, scratch.marks.data() + g.first);
    return b;
  };
  // What lies below the layer of `first` never shows.
  size_t keep_from = 0;
  auto replaceBelow = [&](size_t first) {
    for (size_t i = keep_from; i < first; ++i) scratch.bounds[i].live = false;
    keep_from = first;
    out.initial = kFar;
    out.initial_label = 0;
  };

  // Forward, layer by layer.
  for (size_t first = 0; first < groups;) {
    if (program.groups[first].smooth > 0) {
      if (foldSmooth(program.groups[first], bound(first), field)) replaceBelow(first);
      ++first;
      continue;
    }
    const uint32_t layer = program.groups[first].layer;
    size_t last = first;
    double add_hi = field.hi, cut_hi = 1e300;
    Interval adds{1e300, 1e300}, cuts{1e300, 1e300};
    for (; last < groups && program.groups[last].layer == layer; ++last) {
      const auto& b = bound(last);
      if (!b.met) continue;
      const bool cut = program.groups[last].cut;
      Interval& side = cut ? cuts : adds;
      side.lo = std::min(side.lo, b.value.lo);
      if (b.whole) {
        side.hi = std::min(side.hi, b.value.hi);
        double& hi = cut ? cut_hi : add_hi;
        hi = std::min(hi, b.value.hi);
      }
    }
    const Interval joined{std::min(field.lo, adds.lo), std::min(field.hi, adds.hi)};
    // An add above the layer's ceiling never is the minimum; a cut above another cut, or under the solid, never shows.
    const bool replaced = adds.hi < field.lo;
    for (size_t i = first; i < last; ++i) {
      auto& b = scratch.bounds[i];
      if (!b.met) continue;
      b.live = program.groups[i].cut ? b.value.lo <= cut_hi && -b.value.lo >= joined.lo : b.value.lo <= add_hi;
    }
    if (replaced) replaceBelow(first);
    field = {std::max(joined.lo, -cuts.hi), std::max(joined.hi, -cuts.lo)};
    first = last;
  }
  out.field = field;
  if (out.solid() || out.empty()) return;
  for (size_t i = 0; i < groups; ++i) {
    if (!scratch.bounds[i].live) continue;
    const ProgramGroup& g = program.groups[i];
    keepGroup(program, g, scratch.marks.data() + g.first, !scratch.bounds[i].whole, scratch.reversed, out);
  }
}

}  // namespace sgm

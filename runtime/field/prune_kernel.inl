// Interval pruning for any arithmetic of bounds. Include this file in a namespace that defines
//   Scalar, Bound                      a number, and bounds of a number: lo, hi
//   Places, movePlaces                 a box of positions, and a function that bounds its image under a warp
//   boundPosition, boundOperands, boundRoundShare, boundRoundEnd, boundSumEnd, boundRoundUnion, boundRoundCut
//   GroupBounds                        a struct with bounds of a group; value: a Bound of its result; met: the group's
//                                      influence box meets the box; whole: it contains the box; live: the group has an
//                                      effect in the box
//   kNever, kLess, kMore               a number beyond every bound; factors that exceed the rounding error of a sum
//   minOf, maxOf, floatOf              minimum and maximum of two numbers; the float in a parameter word

#include "field/operands.inl"

enum Choice { kBoth, kFirst, kSecond };

SGM_KERNEL bool readsPosition(Op op) {
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

// Records which registers contain the floor of another register's current value. The difference of a value and its
// floor lies in 0..1, which cannot be concluded from the bounds of the two registers.
struct FloorSources {
  uint32_t known = 0;                   // mask of the registers that contain the floor of another register
  uint32_t floors[kMaxRegisters] = {};  // for each register: mask of the registers that contain the floor of its value
  uint8_t source[kMaxRegisters] = {};

  SGM_KERNEL bool floorOf(uint8_t a, uint8_t b) const { return (known >> b & 1) != 0 && source[b] == a; }
  SGM_KERNEL void overwrite(uint8_t r) {
    known &= ~(floors[r] | 1u << r);
    floors[r] = 0;
  }
  SGM_KERNEL void hold(uint8_t r, uint8_t from) {
    if (r == from) return;
    known |= 1u << r;
    floors[from] |= 1u << r;
    source[r] = from;
  }
};

// Bounds the result of one group. Writes a mark for each instruction, which the backward pass (keepGroup) reads. For a
// min, max, cut or morph, the mark's lo is the Choice of the operands that matter; for an accumulating op, the mark is
// the bounds of its operand.
template <class Marks>
SGM_KERNEL Bound boundGroup(const ProgramView& program, const ProgramGroup& g, const Places& box, Marks marks) {
  Bound r[kMaxRegisters];
  Places places[kMaxPlaces];
  places[0] = box;
  FloorSources floors;
  for (uint32_t i = 0; i < g.count; ++i) {
    const Instr& in = program.instrs[g.first + i];
    const uint32_t* params = program.params.data() + in.params;
    const Bound a = r[in.a], b = r[in.b], c = r[in.c];
    Choice choice = kBoth;
    switch (in.op) {
      case Op::round_begin:
        r[in.dst] = {Scalar{kFar}, Scalar{kFar}};
        r[in.b] = {0, 0};
        floors.overwrite(in.dst);
        floors.overwrite(in.b);
        break;
      case Op::round_add: {
        const Bound share = boundRoundShare(params, a);
        marks[g.first + i] = a;
        r[in.dst] = {minOf(r[in.dst].lo, a.lo), minOf(r[in.dst].hi, a.hi)};
        const Scalar hi = b.hi + share.hi;
        r[in.b] = {maxOf(Scalar{0}, (b.lo + share.lo) * kLess), hi * kMore};
        continue;
      }
      case Op::round_end:
        marks[g.first + i] = a;
        r[in.dst] = boundRoundEnd(params, a, b);
        floors.overwrite(in.dst);
        continue;
      case Op::sum_begin:
        r[in.dst] = {0, 0};
        r[in.b] = {0, 0};
        floors.overwrite(in.dst);
        floors.overwrite(in.b);
        break;
      case Op::sum_add:
        marks[g.first + i] = a;
        r[in.dst] = {maxOf(r[in.dst].lo, a.lo), maxOf(r[in.dst].hi, a.hi)};
        r[in.b] = {(b.lo + a.lo) * kLess, (b.hi + a.hi) * kMore};
        continue;
      case Op::sum_end:
        r[in.dst] = boundSumEnd(params, b);
        floors.overwrite(in.dst);
        break;
      case Op::warp:
        places[in.dst] = movePlaces(places[in.place], a, b, c);
        break;
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
        if (in.op == Op::subtract && floors.floorOf(in.a, in.b) && a.lo > Scalar{-1.0e9f} && a.hi < Scalar{1.0e9f})
          r[in.dst] = {maxOf(r[in.dst].lo, Scalar{0}), minOf(r[in.dst].hi, Scalar{1})};
        floors.overwrite(in.dst);
        if (in.op == Op::floor) floors.hold(in.dst, in.a);
        break;
    }
    marks[g.first + i] = {static_cast<Scalar>(choice), 0};
  }
  return r[g.result];
}

// Visits the instructions of a group backwards, and calls keep(instr) for each instruction that the group's result
// needs.
template <class Marks, class Keep>
SGM_KERNEL void keepGroup(const ProgramView& program, const ProgramGroup& g, Marks marks, const Keep& keep) {
  uint32_t live = 1u << g.result, live_places = 0;
  Scalar nearest_hi[kMaxRegisters] = {};
  for (uint32_t i = g.count; i-- > 0;) {
    Instr in = program.instrs[g.first + i];
    const uint32_t dst = 1u << in.dst;
    switch (in.op) {
      case Op::warp:
        if (!(live_places & dst)) continue;
        live_places &= ~dst;
        live |= operandMask(in);
        live_places |= 1u << in.place;
        keep(in);
        continue;
      case Op::round_add:
      case Op::sum_add: {
        if (!(live & dst)) continue;
        const Bound d = marks[g.first + i];
        if (in.op == Op::sum_add) {
          if (d.hi <= 0) continue;
        } else {
          const Scalar k = Scalar{floatOf(program.params[in.params])};
          if (d.lo >= k && d.lo > nearest_hi[in.dst]) continue;
        }
        live |= operandMask(in);
        keep(in);
        continue;
      }
      case Op::round_begin:
      case Op::sum_begin:
        if (!(live & dst)) continue;
        live &= ~(dst | 1u << in.b);
        keep(in);
        continue;
      default:
        break;
    }
    if (!(live & dst)) continue;
    live &= ~dst;
    if (in.op == Op::round_end) {
      nearest_hi[in.a] = marks[g.first + i].hi;
    } else if (in.op == Op::minimum || in.op == Op::maximum || in.op == Op::cut || in.op == Op::morph) {
      const auto choice = static_cast<Choice>(static_cast<int>(marks[g.first + i].lo));
      if (choice != kBoth) {
        const uint8_t from = choice == kFirst ? in.a : in.b;
        live |= 1u << from;
        if (from != in.dst) {
          in = Instr{Op::copy, in.dst, from, 0, 0, in.place, 0, 0};
          keep(in);
        }
        continue;
      }
    }
    live |= operandMask(in);
    if (readsPosition(in.op)) live_places |= 1u << in.place;
    keep(in);
  }
}

// Combines the bounds of a smooth group with the bounds of the field. Returns true if the group replaces the field. k:
// the width of the group's blend. A group that adds has no effect if its value is at least k and not below the field's
// value; a group that cuts, if its value is at least k and not below the negated field's value. Conversely, a group
// that adds replaces the field if the field's value is at least k and above the group's value.
SGM_KERNEL bool foldSmooth(const ProgramGroup& g, GroupBounds& b, Bound& field) {
  const Scalar k = Scalar{g.smooth};
  const Bound under = field, distance = g.cut ? Bound{-under.hi, -under.lo} : under;
  b.live = b.met && !(b.value.lo >= k && b.value.lo >= distance.hi);
  if (!b.live) return false;
  field = g.cut ? boundRoundCut(under, b.value, k) : boundRoundUnion(under, b.value, k);
  if (!b.whole) field = {minOf(field.lo, under.lo), maxOf(field.hi, under.hi)};
  return !g.cut && b.whole && under.lo >= k && under.lo > b.value.hi;
}

/// The bounds of a field over a box.
struct FieldBounds {
  Bound field;
  /// true: groups hide the domain everywhere in the box, so that the program's initial value has no effect
  bool hidden = false;
};

// Bounds the field, and determines the groups that have an effect (GroupBounds::live). box and places describe the same
// box.
template <class Marks, class Groups>
SGM_KERNEL FieldBounds boundField(const ProgramView& program, const IntBox& box, const Places& places, Marks marks,
                                  Groups bounds) {
  FieldBounds result;
  const size_t groups = program.groups.size();
  Bound field{Scalar{program.initial}, Scalar{program.initial}};

  auto bound = [&](size_t i) -> GroupBounds& {
    const ProgramGroup& g = program.groups[i];
    GroupBounds& b = bounds[i];
    b.met = !g.guarded || g.influence.meets(box);
    b.whole = !g.guarded || g.influence.contains(box);
    b.live = b.met;
    if (b.met) b.value = boundGroup(program, g, places, marks);
    return b;
  };
  // All groups before this index have no effect, since the groups of a later layer hide them.
  size_t keep_from = 0;
  auto replaceBelow = [&](size_t first) {
    for (size_t i = keep_from; i < first; ++i) bounds[i].live = false;
    keep_from = first;
    result.hidden = true;
  };

  // The forward pass bounds the field layer by layer.
  for (size_t first = 0; first < groups;) {
    if (program.groups[first].smooth > 0) {
      if (foldSmooth(program.groups[first], bound(first), field)) replaceBelow(first);
      ++first;
      continue;
    }
    const uint32_t layer = program.groups[first].layer;
    size_t last = first;
    Scalar add_hi = field.hi, cut_hi = kNever;
    Bound adds{kNever, kNever}, cuts{kNever, kNever};
    for (; last < groups && program.groups[last].layer == layer; ++last) {
      const GroupBounds& b = bound(last);
      if (!b.met) continue;
      const bool cut = program.groups[last].cut;
      Bound& side = cut ? cuts : adds;
      side.lo = minOf(side.lo, b.value.lo);
      if (b.whole) {
        side.hi = minOf(side.hi, b.value.hi);
        Scalar& hi = cut ? cut_hi : add_hi;
        hi = minOf(hi, b.value.hi);
      }
    }
    const Bound joined{minOf(field.lo, adds.lo), minOf(field.hi, adds.hi)};
    // A group that adds has no effect if its lower bound is above the layer's upper bound, since it is then never the
    // minimum. A group that cuts has no effect if another cut is always stronger, or if the cut surface is always
    // outside of the solid that it cuts.
    const bool replaced = adds.hi < field.lo;
    for (size_t i = first; i < last; ++i) {
      GroupBounds& b = bounds[i];
      if (!b.met) continue;
      b.live = program.groups[i].cut ? b.value.lo <= cut_hi && -b.value.lo >= joined.lo : b.value.lo <= add_hi;
    }
    if (replaced) replaceBelow(first);
    field = {maxOf(joined.lo, -cuts.hi), maxOf(joined.hi, -cuts.lo)};
    first = last;
  }
  result.field = field;
  return result;
}

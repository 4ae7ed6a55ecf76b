// Computes bounds of the records of a program over boxes of positions, one box per invocation (field/prune_kernel.inl).
// This file defines the forms that sweep.glsl expands. The including file must define the box lo..hi, the bounds of the
// field (field), and the bounds for the additions and the cuts of its layers (adds, cuts, add_high, cut_high). It must
// also define three macros, which receive the results. MARK and MARK_WHOLE: the values that decide whether the current
// record stays in the pruned program. MARK_LAYER: the values that decide this within a layer.

const float kNever = 3.0e38f;
const uint kMaxLayers = 64u;

float low[kSlots], high[kSlots];
ivec3 place_low[8], place_high[8];

Bounds slotBounds(uint slot) { return makeBounds(low[slot], high[slot]); }
void setSlot(uint slot, Bounds b) {
  low[slot] = b.lo;
  high[slot] = b.hi;
}

// Returns bounds of the value that an instruction adds to a sum: the counterpart of addend() in addend.glsl.
Bounds addendBounds(Bounds a, Bounds b, uint P) {
  if ((kKindsHigh & kSomeMorphs) != 0u) {
    const Bounds by = makeBounds(PF(P, kByWord), PF(P, kByWord));
    const Bounds morphed = operandBounds(kOp_morph, a, b, by, 0.0f, 0.0f);
    if (HOW(P, kHowMorphs)) a = morphed;
  }
  if ((kKindsHigh & kSomeWeighs) != 0u) {
    const Bounds weight = operandBounds(kOp_kernel, a, a, a, PF(P, 0), PF(P, 1));
    if (HOW(P, kHowWeighs)) a = weight;
  }
  return a;
}

#define BOX makeBox(place_low[place], place_high[place])
#define SIZES uintBitsToFloat(wordOfRecord(30u))
#define MIDDLE_OF(axis) middleOf(place_low[place].axis, place_high[place].axis)
#define SAMPLES makeBounds(PF(P, 11), PF(P, 12))  // bounds of the values of a lattice's samples
#define OPERANDS(a, b, c) setSlot(dst, operandBounds(number, a, b, c, PF(P, 0), PF(P, 1)));
#define NONE makeBounds(0.0f, 0.0f)
#define FORM_CONSTANT(F) OPERANDS(NONE, NONE, NONE)
#define FORM_NOISE(F) setSlot(dst, positionBounds(number, P, 0.0f, 0.0f, NONE, BOX));
#define FORM_POSITION(F)                                                                                 \
  {                                                                                                      \
    Bounds a = slotBounds(ra);                                                                           \
    float middle = F(MIDDLE_OF(x), MIDDLE_OF(y), MIDDLE_OF(z), P).v;                                     \
    Bounds b = positionBounds(number, P, middle, SIZES, SAMPLES, BOX);                                   \
    MARK(float(b.lo > a.hi ? kFirstAlone : a.lo > b.hi ? kSecondAlone : kKept))                          \
    setSlot(dst, makeBounds(min(a.lo, b.lo), min(a.hi, b.hi)));                                          \
  }
#define FORM_POSITION_1(F) \
  setSlot(dst, powerMorphBounds(P, slotBounds(ra), SIZES, BOX));
#define FORM_UNARY(F) OPERANDS(slotBounds(ra), NONE, NONE)
#define FORM_UNARY_P(F) OPERANDS(slotBounds(ra), NONE, NONE)
#define FORM_COPY(F) OPERANDS(slotBounds(ra), NONE, NONE)
#define FORM_BINARY(F)                                                        \
  {                                                                           \
    Bounds a = slotBounds(ra), b = slotBounds(rb);                            \
    uint choice = kKept;                                                      \
    if (number == kOp_minimum) choice = b.lo > a.hi ? kFirstAlone : a.lo > b.hi ? kSecondAlone : kKept; \
    if (number == kOp_maximum) choice = a.lo > b.hi ? kFirstAlone : b.lo > a.hi ? kSecondAlone : kKept; \
    if (number == kOp_cut) choice = a.lo > -b.lo ? kFirstAlone : kKept;       \
    OPERANDS(a, b, NONE)                                                      \
    if (number == kOp_minimum || number == kOp_maximum || number == kOp_cut) MARK(float(choice)) \
  }
#define FORM_TERNARY(F)                                                       \
  {                                                                           \
    Bounds a = slotBounds(ra), b = slotBounds(rb);                            \
    Bounds c = makeBounds(PF(P, kByWord), PF(P, kByWord));                    \
    if (!HOW(P, kHowByConstant)) c = slotBounds(rc);                             \
    Bounds r = operandBounds(number, a, b, c, 0.0f, 0.0f);                    \
    uint choice = kKept;                                                      \
    if (number == kOp_morph) {                                                \
      choice = c.hi <= 0.0f ? kFirstAlone : c.lo >= 1.0f ? kSecondAlone : kKept; \
      if (choice == kFirstAlone) r = a;                                       \
      if (choice == kSecondAlone) r = b;                                      \
      MARK(float(choice))                                    \
    }                                                                         \
    setSlot(dst, r);                                                          \
  }
#define FORM_ROUND_BEGIN(F)                       \
  setSlot(dst, makeBounds(1.0e30f, 1.0e30f));     \
  setSlot(rb, NONE);
#define FORM_ROUND_ADD(F)                                                                     \
  {                                                                                           \
    Bounds a = slotBounds(ra), n = slotBounds(dst), s = slotBounds(rb);                       \
    Bounds share = roundShare(a, PF(P, 0));                                                   \
    MARK(a.lo >= PF(P, 0) ? a.lo : -kNever)                                  \
    setSlot(dst, makeBounds(min(n.lo, a.lo), min(n.hi, a.hi)));                               \
    setSlot(rb, makeBounds((s.lo + share.lo) * 0.999998f, (s.hi + share.hi) * 1.000002f));    \
  }
#define FORM_ROUND_END(F)                                                     \
  MARK(high[ra])                                             \
  setSlot(dst, roundEndRange(slotBounds(ra), slotBounds(rb), PF(P, 0)));
#define FORM_SUM_BEGIN(F) \
  setSlot(dst, NONE);     \
  setSlot(rb, NONE);
#define FORM_SUM_ADD(F)                                                                       \
  {                                                                                           \
    Bounds a = addendBounds(slotBounds(ra), slotBounds(rc), P);                               \
    Bounds n = slotBounds(dst), s = slotBounds(rb);                                           \
    MARK(a.hi)                                                               \
    setSlot(dst, makeBounds(max(n.lo, a.lo), max(n.hi, a.hi)));                               \
    setSlot(rb, sumOf(s, a));                                                                 \
  }
#define FORM_SUM_END(F) setSlot(dst, sumEndRange(slotBounds(rb), PF(P, 0), PF(P, 1)));
#define FORM_WARP(F)                                                                          \
  {                                                                                           \
    ivec3 from = place_low[place], to = place_high[place];                                    \
    place_low[dst] = ivec3(movedTo(from.x, low[ra], -1.0f), movedTo(from.y, low[rb], -1.0f),  \
                           movedTo(from.z, low[rc], -1.0f));                                  \
    place_high[dst] = ivec3(movedTo(to.x, high[ra], 1.0f), movedTo(to.y, high[rb], 1.0f),     \
                            movedTo(to.z, high[rc], 1.0f));                                   \
    bvec3 wraps = bvec3(place_low[dst].x == -2147483647 - 1 || place_high[dst].x == 2147483647, \
                        place_low[dst].y == -2147483647 - 1 || place_high[dst].y == 2147483647, \
                        place_low[dst].z == -2147483647 - 1 || place_high[dst].z == 2147483647); \
    place_low[dst] = mix(place_low[dst], ivec3(-2147483647 - 1), wraps);                      \
    place_high[dst] = mix(place_high[dst], ivec3(2147483647), wraps);                         \
  }
#define GROUP                                                                                          \
  const ivec3 g_lo = ivec3(PI(P, 0), PI(P, 1), PI(P, 2)), g_hi = ivec3(PI(P, 3), PI(P, 4), PI(P, 5));  \
  const uint flags = PU(P, 6);                                                                         \
  const bool cut = (flags & 1u) != 0u, guarded = (flags & 2u) != 0u;                                   \
  const bool met = !guarded || (all(lessThanEqual(g_lo, hi)) && all(greaterThanEqual(g_hi, lo)));      \
  const bool whole = !guarded || (all(lessThanEqual(g_lo, lo)) && all(greaterThanEqual(g_hi, hi)));    \
  const Bounds value = slotBounds(ra);
#define FORM_FOLD                                                             \
  {                                                                           \
    GROUP                                                                     \
    const bool ends = (flags & kEndsLayer) != 0u;                             \
    const uint layer = min(slots_word, kMaxLayers - 1u);                     \
    MARK(met ? value.lo : kNever)                            \
    MARK_WHOLE(whole ? 1.0f : 0.0f) \
    float met_low = met && !ends ? value.lo : kNever;                         \
    float whole_high = met && whole && !ends ? value.hi : kNever;             \
    adds.lo = cut ? adds.lo : min(adds.lo, met_low);                          \
    adds.hi = cut ? adds.hi : min(adds.hi, whole_high);                       \
    add_high = cut ? add_high : min(add_high, whole_high);                    \
    cuts.lo = cut ? min(cuts.lo, met_low) : cuts.lo;                          \
    cuts.hi = cut ? min(cuts.hi, whole_high) : cuts.hi;                       \
    cut_high = cut ? min(cut_high, whole_high) : cut_high;                    \
    if (ends) {                                                               \
      MARK_LAYER(layer, min(field.lo, adds.lo), adds.hi < field.lo) \
      field = layerJoined(field, adds, cuts);                                 \
      adds = makeBounds(kNever, kNever);                                      \
      cuts = makeBounds(kNever, kNever);                                      \
      add_high = field.hi;                                                    \
      cut_high = kNever;                                                      \
    }                                                                         \
  }
// A smooth union blends over a width k. If the group's value is at least k, and not less than the field, the field
// stays the same, bit for bit. If the field is at least k and greater than the group's value, the group replaces the
// field.
#define FORM_SMOOTH                                                                                   \
  {                                                                                                   \
    GROUP                                                                                             \
    const float k = PF(P, 7);                                                                         \
    const Bounds under = layerJoined(field, adds, cuts), distance = cut ? negated(under) : under;                              \
    const bool live = met && !(value.lo >= k && value.lo >= distance.hi);                             \
    Bounds joined = roundUnionRange(distance, value, k);                                              \
    if (cut) joined = negated(joined);                                                                \
    if (!whole) joined = makeBounds(min(joined.lo, under.lo), max(joined.hi, under.hi));              \
    const bool replaces = live && !cut && whole && under.lo >= k && under.lo > value.hi;              \
    MARK(live ? 0.0f : kNever)                                                       \
    MARK_WHOLE((whole ? 1.0f : 0.0f) + (replaces ? 2.0f : 0.0f)) \
    field = under;                                                                                    \
    if (live) field = joined;                                                                         \
    adds = makeBounds(kNever, kNever);                                                                \
    cuts = makeBounds(kNever, kNever);                                                                \
    cut_high = kNever;                                                                                \
    add_high = field.hi;                                                                              \
  }

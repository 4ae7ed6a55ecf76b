// Bounds flow through a program, one box of positions an invocation: the forms of sweep.glsl for them (field/prune.cpp).
// Needs the box lo..hi, the field and what its layers add and take away (field, adds, cuts, add_high, cut_high); MARK and
// MARK_WHOLE take what decides whether the current record stays, MARK_LAYER what decides it in a layer.

const float kNever = 3.0e38f;
const uint kMostLayers = 64u;

float low[kSlots], high[kSlots];
ivec3 place_low[8], place_high[8];

Bounds slotBounds(uint slot) { return makeBounds(low[slot], high[slot]); }
void setSlot(uint slot, Bounds b) {
  low[slot] = b.lo;
  high[slot] = b.hi;
}

// The field with what a layer adds and takes away. A list of what pruning left has no end of layers that take nothing
// away: what they add waits for whatever comes next.
Bounds layerJoined(Bounds field, Bounds adds, Bounds cuts) {
  return makeBounds(max(min(field.lo, adds.lo), -cuts.hi), max(min(field.hi, adds.hi), -cuts.lo));
}

int movedTo(int at, float by, float slack) {
  float to = float(at) + clamp(by, -1048576.0f, 1048576.0f) * 1024.0f;
  to = to + slack * (2.0f + 4.0e-7f * (abs(float(at)) + abs(to)));
  return to < -2147483000.0f ? -2147483647 - 1 : to > 2147483000.0f ? 2147483647 : int(to);
}

// Of an op that reads a position, from its value at the middle of the box.
Bounds positionBounds(uint number, float middle, ivec3 lo, ivec3 hi) {
  const uint P = 0u;
  float error = kStatedErrors[number];
  if (number == kOp_noise) return makeBounds(-1.0f, 1.0f);
  if (number == kOp_sweep) return makeBounds(-2.0e-6f, 1.0f + 2.0e-6f);
  if (number == kOp_lattice) {
    Bounds all = makeBounds(PF(P, 11), PF(P, 12));
    all = widened(all, 2.0f * error * magnitudeOf(all));
    bool far = all.hi >= PF(P, 9) || all.lo <= -PF(P, 9);
    return far ? makeBounds(-kHeldAt, kHeldAt) : all;
  }
  Bounds x = offsetRange(lo.x, hi.x, PI(P, 1)), y = offsetRange(lo.y, hi.y, PI(P, 2)), z = offsetRange(lo.z, hi.z, PI(P, 3));
  if (number == kOp_coordinate) {
    x = productOf(x, makeBounds(PF(P, 4), PF(P, 4)));
    y = productOf(y, makeBounds(PF(P, 5), PF(P, 5)));
    z = productOf(z, makeBounds(PF(P, 6), PF(P, 6)));
    return widened(sumOf(sumOf(x, y), z), 4.0f * error * (magnitudeOf(x) + magnitudeOf(y) + magnitudeOf(z)));
  }
  if (number == kOp_blob) {
    Bounds d2 = sumOf(sumOf(squareOf(x), squareOf(y)), squareOf(z));
    d2 = makeBounds(max(d2.lo, 0.0f), d2.hi);
    return kernelRange(productOf(d2, makeBounds(PF(P, 4), PF(P, 4))), 2.0f * error);
  }
  // None is steeper than 1 (primitives.h).
  vec3 extent = vec3(float(uint(hi.x - lo.x)), float(uint(hi.y - lo.y)), float(uint(hi.z - lo.z))) * 0.5f + 1.0f;
  float radius = sqrtReal(extent.x * extent.x + extent.y * extent.y + extent.z * extent.z) * 1.00001f;
  float farthest = magnitudeOf(x) + magnitudeOf(y) + magnitudeOf(z);
  float sizes = uintBitsToFloat(wordOfRecord(30u));
  return widened(makeBounds(middle - radius, middle + radius), 3.0f * error * (farthest + sizes));
}

// Between its ends the norm falls as t grows the exponent, and the radii move: bounded from both, with the two effects
// taken apart. ||u||_n <= ||u||_2 and >= ||u||_max, each for the smaller and the larger radii.
Bounds powerMorphBounds(ivec3 middle, Bounds t, ivec3 lo, ivec3 hi) {
  const uint P = 0u;
  Bounds s = clampedTo(t, 0.0f, 1.0f);
  vec3 extent = vec3(float(uint(hi.x - lo.x)), float(uint(hi.y - lo.y)), float(uint(hi.z - lo.z))) * 0.5f + 1.0f;
  float radius = sqrtReal(extent.x * extent.x + extent.y * extent.y + extent.z * extent.z) * 1.00001f;
  Bounds x = offsetRange(lo.x, hi.x, PI(P, 1)), y = offsetRange(lo.y, hi.y, PI(P, 2)), z = offsetRange(lo.z, hi.z, PI(P, 3));
  float farthest = magnitudeOf(x) + magnitudeOf(y) + magnitudeOf(z);
  float slack = 3.0f * kStatedErrors[kOp_power_morph] * (farthest + uintBitsToFloat(wordOfRecord(30u)));
  Vec3 local = toLocal(middle.x, middle.y, middle.z, P);
  vec3 q = abs(vec3(local.x, local.y, local.z));
  vec3 a = vec3(PF(P, 13), PF(P, 14), PF(P, 15)), b = vec3(PF(P, 16), PF(P, 17), PF(P, 18));
  vec3 r0 = (1.0f - s.lo) * a + s.lo * b, r1 = (1.0f - s.hi) * a + s.hi * b;
  vec3 small = min(r0, r1) * 0.99999f, large = max(r0, r1) * 1.00001f;
  float reach = radius + slack;
  vec3 within = max(q - reach, vec3(0.0f));
  vec3 lowest = within * vec3(recipReal(large.x), recipReal(large.y), recipReal(large.z));
  vec3 u = (q + reach) * vec3(recipReal(small.x), recipReal(small.y), recipReal(small.z));
  float norm_low = max(lowest.x, max(lowest.y, lowest.z)) * 0.9999f - 1.0f;
  float norm_high = sqrtReal(u.x * u.x + u.y * u.y + u.z * u.z) * 1.0001f - 1.0f;
  float smallest_low = min(small.x, min(small.y, small.z)), smallest_high = min(large.x, min(large.y, large.z));
  return widened(makeBounds(norm_low * (norm_low > 0.0f ? smallest_low : smallest_high),
                            norm_high * (norm_high > 0.0f ? smallest_high : smallest_low)), slack);
}

#define LO place_low[place]
#define HI place_high[place]
#define MIDDLE_OF(axis) (place_low[place].axis + int(uint(place_high[place].axis - place_low[place].axis) >> 1))
#define OPERANDS(a, b, c) setSlot(dst, operandBounds(number, a, b, c, PF(P, 0), PF(P, 1)));
#define NONE makeBounds(0.0f, 0.0f)
#define FORM_CONSTANT(F) OPERANDS(NONE, NONE, NONE)
#define FORM_NOISE(F) setSlot(dst, positionBounds(number, 0.0f, LO, HI));
#define FORM_POSITION(F)                                                                                 \
  {                                                                                                      \
    Bounds a = slotBounds(ra);                                                                           \
    Bounds b = positionBounds(number, F(MIDDLE_OF(x), MIDDLE_OF(y), MIDDLE_OF(z), P).v, LO, HI);         \
    MARK(float(b.lo > a.hi ? kFirstAlone : a.lo > b.hi ? kSecondAlone : kKept))                          \
    setSlot(dst, makeBounds(min(a.lo, b.lo), min(a.hi, b.hi)));                                          \
  }
#define FORM_POSITION_1(F) \
  setSlot(dst, powerMorphBounds(ivec3(MIDDLE_OF(x), MIDDLE_OF(y), MIDDLE_OF(z)), slotBounds(ra), LO, HI));
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
    Bounds a = slotBounds(ra), b = slotBounds(rb), c = slotBounds(rc);        \
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
    Bounds a = slotBounds(ra), n = slotBounds(dst), s = slotBounds(rb);                       \
    MARK(a.hi)                                                               \
    setSlot(dst, makeBounds(max(n.lo, a.lo), max(n.hi, a.hi)));                               \
    setSlot(rb, sumOf(s, a));                                                                 \
  }
#define FORM_SUM_END(F) setSlot(dst, sumEndRange(slotBounds(rb), PF(P, 0), PF(P, 1)));
#define FORM_WARP(F)                                                                          \
  {                                                                                           \
    ivec3 from = LO, to = HI;                                                                 \
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
    const uint layer = min(slots_word, kMostLayers - 1u);                     \
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
// Where a smooth group is its width away and no nearer than the field, the field keeps its bits; where the field is, the
// group takes its place.
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

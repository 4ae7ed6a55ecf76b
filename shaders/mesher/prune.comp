#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require

// A program cut down to what matters in each of up to 64 boxes, one an invocation: field/prune.h says how, and why no
// sample in the box changes a bit. Forward, bounds flow through all records; backward, the list of those that are left
// is written from its end.

layout(local_size_x_id = 0) in;

#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/items.glsl"
#include "mesher/tape.glsl"
#include "op_numbers.glsl"
#include "common/common.h"
#include "mesher/bounds.glsl"

const uint kEndOfWindow = 0xFFu;
const uint kMostRecords = 1024u;
const uint kMostLayers = 64u;
const float kNever = 3.0e38f;

float low[64], high[64];
ivec3 place_low[8], place_high[8];
float mark[kMostRecords];   // what decides whether a record stays
float whole_mark[kMostRecords];
float layer_add[kMostLayers], layer_cut[kMostLayers], layer_joined[kMostLayers], layer_replaced[kMostLayers];
float nearest_high[64];     // by slot: of a round union that ends

Bounds slotBounds(uint slot) { return makeBounds(low[slot], high[slot]); }
void setSlot(uint slot, Bounds b) {
  low[slot] = b.lo;
  high[slot] = b.hi;
}

// Records from..end of the program into the window; returns the first that found no room.
uint fillWindow(uint headers, uint from, uint end) {
  uint lane = gl_SubgroupInvocationID & 7u;
  uint filled = 0u;
  uint at = from;
  do {
    uint place = batch_fours[headers + at].z * 8u;
    uvec4 words = batch_fours[place + lane];
    uint pieces = subgroupShuffle(words.x, 0u) >> 16;
    bool fits = filled + pieces + 1u < kWindow;
    window[filled] = words;
    uint piece = 1u;
    while (piece < pieces && fits) {
      window[filled + piece] = batch_fours[place + 8u * piece + lane];
      ++piece;
    }
    filled += fits ? pieces : 0u;
    at += fits ? 1u : 0u;
    if (!fits) break;
  } while (at < end);
  window[filled] = uvec4(kEndOfWindow);
  return at;
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

void main() {
  const uint job = jobs_at + kJobWords * gl_WorkGroupID.x;
  const uint which = gl_WorkGroupID.y * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  const uint kind_of_job = batch[job + kJobKind];
  const uint headers = batch[job + kJobHeaders], records = batch[job + kJobRecords];
  const uint chunk_number = batch[job + kJobChunk];
  const uint chunk = kChunkWords * chunk_number;
  const bool bricks = kind_of_job == 0u;
  const bool used = which < (bricks ? kBricks : batch[job + kJobSeams]);
  const uint seam_number = batch[job + kJobFirstSeam] + min(which, max(batch[job + kJobSeams], 1u) - 1u);
  const uint seam = seam_records + kSeamWords * seam_number;
  const int cell = int(batch[chunk + kChunkCell]);
  const ivec3 origin =
      ivec3(batch[chunk + kChunkOrigin], batch[chunk + kChunkOrigin + 1u], batch[chunk + kChunkOrigin + 2u]);
  const float scale = uintBitsToFloat(batch[job + kJobScale]);
  const float initial = uintBitsToFloat(batch[job + kJobInitial]);

  // A uniform brick is proven with one sample around it, so that no edge that leaves it changes sign either.
  ivec3 lo = origin + max(ivec3(firstOfBrick(which)) - 1, ivec3(0)) * cell;
  ivec3 hi = origin + min(ivec3(lastOfBrick(which)) + 1, ivec3(32)) * cell;
  if (!bricks) {
    uint face = batch[seam + kSeamFace];
    uint axis = face >> 1;
    lo = origin;
    hi = origin + 32 * cell;
    int at = (face & 1u) != 0u ? hi[axis] : lo[axis];
    lo[axis] = at;
    hi[axis] = at;
  }
  place_low[0] = lo;
  place_high[0] = hi;

  Bounds field = makeBounds(initial, initial);
  Bounds adds = makeBounds(kNever, kNever), cuts = makeBounds(kNever, kNever);
  float add_high = field.hi, cut_high = kNever;
  record_number = 0u;
  uint next = 0u;
  if (records > 0u) do {
    next = fillWindow(headers, next, records);
#define LO place_low[place]
#define HI place_high[place]
#define MIDDLE_OF(axis) (place_low[place].axis + int(uint(place_high[place].axis - place_low[place].axis) >> 1))
#define OPERANDS(a, b, c) setSlot(dst, operandBounds(number, a, b, c, PF(P, 0), PF(P, 1)));
#define NONE makeBounds(0.0f, 0.0f)
#define FORM_CONSTANT(F) OPERANDS(NONE, NONE, NONE)
#define FORM_POSITION(F) \
  setSlot(dst, positionBounds(number, F(MIDDLE_OF(x), MIDDLE_OF(y), MIDDLE_OF(z), P).v, LO, HI));
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
    if (number == kOp_minimum || number == kOp_maximum || number == kOp_cut) mark[record_number] = float(choice); \
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
      mark[record_number] = float(choice);                                    \
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
    mark[record_number] = a.lo >= PF(P, 0) ? a.lo : -kNever;                                  \
    setSlot(dst, makeBounds(min(n.lo, a.lo), min(n.hi, a.hi)));                               \
    setSlot(rb, makeBounds((s.lo + share.lo) * 0.999998f, (s.hi + share.hi) * 1.000002f));    \
  }
#define FORM_ROUND_END(F)                                                     \
  mark[record_number] = high[ra];                                             \
  setSlot(dst, roundEndRange(slotBounds(ra), slotBounds(rb), PF(P, 0)));
#define FORM_SUM_BEGIN(F) \
  setSlot(dst, NONE);     \
  setSlot(rb, NONE);
#define FORM_SUM_ADD(F)                                                                       \
  {                                                                                           \
    Bounds a = slotBounds(ra), n = slotBounds(dst), s = slotBounds(rb);                       \
    mark[record_number] = a.hi;                                                               \
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
    mark[record_number] = met ? value.lo : kNever;                            \
    whole_mark[record_number] = whole ? 1.0f : 0.0f;                          \
    float met_low = met && !ends ? value.lo : kNever;                         \
    float whole_high = met && whole && !ends ? value.hi : kNever;             \
    adds.lo = cut ? adds.lo : min(adds.lo, met_low);                          \
    adds.hi = cut ? adds.hi : min(adds.hi, whole_high);                       \
    add_high = cut ? add_high : min(add_high, whole_high);                    \
    cuts.lo = cut ? min(cuts.lo, met_low) : cuts.lo;                          \
    cuts.hi = cut ? min(cuts.hi, whole_high) : cuts.hi;                       \
    cut_high = cut ? min(cut_high, whole_high) : cut_high;                    \
    if (ends) {                                                               \
      Bounds joined = makeBounds(min(field.lo, adds.lo), min(field.hi, adds.hi)); \
      layer_add[layer] = add_high;                                            \
      layer_cut[layer] = cut_high;                                            \
      layer_joined[layer] = joined.lo;                                        \
      layer_replaced[layer] = adds.hi < field.lo ? 1.0f : 0.0f;               \
      field = makeBounds(max(joined.lo, -cuts.hi), max(joined.hi, -cuts.lo)); \
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
    const Bounds under = field, distance = cut ? negated(under) : under;                              \
    const bool live = met && !(value.lo >= k && value.lo >= distance.hi);                             \
    Bounds joined = roundUnionRange(distance, value, k);                                              \
    if (cut) joined = negated(joined);                                                                \
    if (!whole) joined = makeBounds(min(joined.lo, under.lo), max(joined.hi, under.hi));              \
    const bool replaces = live && !cut && whole && under.lo >= k && under.lo > value.hi;              \
    mark[record_number] = live ? 0.0f : kNever;                                                       \
    whole_mark[record_number] = (whole ? 1.0f : 0.0f) + (replaces ? 2.0f : 0.0f);                     \
    if (live) field = joined;                                                                         \
    add_high = field.hi;                                                                              \
  }
#include "mesher/sweep.glsl"
  } while (next < records);

  const bool solid = field.hi * scale < -0.55f, empty = field.lo * scale > -0.45f;
  const uint list_end = batch[job + kJobLists] + (which + 1u) * records;
  uint begin = list_end;
  uint live_low = 0u, live_high = 0u, live_places = 0u;
  bool below = false, replaced = false;  // what lies below a layer that covers all never shows
  float limit_add = 0.0f, limit_cut = 0.0f, limit_joined = 0.0f;
  const bool listed = used && (!bricks || !(solid || empty));
  uint r = records;
  uvec4 headers_here = uvec4(0u);
  uint lane = gl_SubgroupInvocationID & 7u;
  if (records > 0u) do {
    --r;
    headers_here = batch_fours[headers + (r & ~7u) + lane];
    const uint head_word = subgroupShuffle(headers_here.x, r & 7u), slots_word = subgroupShuffle(headers_here.y, r & 7u);
    const uint record_place = subgroupShuffle(headers_here.z, r & 7u), traits = subgroupShuffle(headers_here.w, r & 7u);
    const uint dst = slots_word & 0xFFu, ra = slots_word >> 8 & 0xFFu, rb = slots_word >> 16 & 0xFFu, rc = slots_word >> 24;
    const uint place = head_word >> 8 & 0xFFu;
    const float m = mark[r], w = whole_mark[r];
    const bool is_fold = (traits & kIsFold) != 0u, is_smooth = (traits & kIsSmooth) != 0u;
    const bool is_end = (traits & kIsLayerEnd) != 0u, cuts_too = (traits & kCuts) != 0u;
    const bool is_op = !(is_fold || is_smooth || is_end);
    if (is_end || is_smooth) below = below || replaced;
    const uint layer = is_end ? slots_word : 0u;
    if (is_end) {
      limit_add = layer_add[layer];
      limit_cut = layer_cut[layer];
      limit_joined = layer_joined[layer];
      replaced = layer_replaced[layer] > 0.0f;
    }
    const bool writes = (traits & (kBeginsTwo | kAddsTo)) == 0u;
    const bool dst_live = ((traits & kMakesPlace) != 0u ? live_places >> dst
                           : dst < 32u ? live_low >> dst : live_high >> (dst - 32u)) % 2u == 1u;
    bool keep = is_op && dst_live;
    uint choice = kKept;
    bool emit = keep;
    if ((traits & kAddsTo) != 0u) {
      keep = keep && !((traits & kAddsRound) != 0u ? m > nearest_high[dst] : m <= 0.0f);
      emit = keep;
    }
    if (keep && (traits & kEndsRound) != 0u) nearest_high[ra] = m;
    if (keep && (traits & kChooses) != 0u) {
      choice = uint(m);
      emit = choice == kKept || dst != (choice == kFirstAlone ? ra : rb);
    }
    if (is_fold) keep = !below && m < kNever && (cuts_too ? m <= limit_cut && -m >= limit_joined : m <= limit_add);
    if (is_smooth) keep = !below && m < kNever;
    if (is_end) keep = !below && cuts_too;
    if (!is_op) emit = keep;
    if (keep && (is_fold || is_smooth)) choice = (uint(w) & 1u) != 0u ? kFirstAlone : kKept;
    if (is_smooth) {
      replaced = keep && uint(w) >= 2u;
    }

    // What it makes is not wanted any more, what it reads is.
    const uint dst_low = dst < 32u ? 1u << dst : 0u, dst_high = dst >= 32u ? 1u << (dst - 32u) : 0u;
    const uint two_low = rb < 32u ? 1u << rb : 0u, two_high = rb >= 32u ? 1u << (rb - 32u) : 0u;
    if (keep && is_op && (traits & (kAddsTo | kMakesPlace)) == 0u) {
      live_low &= ~dst_low;
      live_high &= ~dst_high;
      if ((traits & kBeginsTwo) != 0u) {
        live_low &= ~two_low;
        live_high &= ~two_high;
      }
    }
    if (keep && (traits & kMakesPlace) != 0u) live_places &= ~(1u << dst);
    const uint operands = traits & kOperands;
    const bool chooses = is_op && choice != kKept;
    const bool read_a = keep && operands > 0u && !(chooses && choice == kSecondAlone);
    const bool read_b = keep && (operands > 1u || (traits & kAddsTo) != 0u) && !(chooses && choice == kFirstAlone);
    const bool read_c = keep && operands > 2u && !chooses;
    live_low |= (read_a && ra < 32u ? 1u << ra : 0u) | (read_b ? two_low : 0u) | (read_c && rc < 32u ? 1u << rc : 0u);
    live_high |= (read_a && ra >= 32u ? 1u << (ra - 32u) : 0u) | (read_b ? two_high : 0u) |
                 (read_c && rc >= 32u ? 1u << (rc - 32u) : 0u);
    if (keep && (traits & (kReadsPosition | kMakesPlace)) != 0u && !chooses) live_places |= 1u << place;
    if (emit && listed) {
      --begin;
      scratch[begin] = record_place | choice << 30;
    }
  } while (r > 0u);

  if (used) {
    const uint item = bricks ? brickItem(chunk_number, which) : planeItem(seam_number, kind_of_job - 1u);
    scratch[item + kItemList] = begin;
    scratch[item + kItemCount] = list_end - begin;
    scratch[item + kItemFlags] = (solid ? kItemSolid : 0u) | (empty ? kItemEmpty : 0u);
    // What the layers below the last that covers all would have been is hidden by it.
    scratch[item + kItemInitial] = below || replaced ? floatBitsToUint(1.0e30f) : batch[job + kJobInitial];
    scratch[item + kItemLabel] = below || replaced ? 0u : batch[job + kJobLabel];
    scratch[item + kItemScale] = batch[job + kJobScale];
    scratch[item + kItemOwner] = bricks ? chunk : seam;
    // Where only seams are asked for, only what touches their faces is sampled.
    const uint faces = batch[chunk + kChunkFaces];
    const uvec3 at_low = uvec3(equal(firstOfBrick(which), uvec3(0u))), at_high = uvec3(equal(lastOfBrick(which), uvec3(32u)));
    const uint touched = at_low.x | at_high.x << 1 | at_low.y << 2 | at_high.y << 3 | at_low.z << 4 | at_high.z << 5;
    const bool wanted = kind_of_job == 2u || faces == 0u || (faces & touched) != 0u;
    if (!(solid || empty) && kind_of_job != 1u && wanted) {
      const uint passes = (729u + 4u * gl_WorkGroupSize.x - 1u) / (4u * gl_WorkGroupSize.x);
      const uint slices = min(passes * roundsOf(list_end - begin) / kMostRounds + 1u, kMostSlices);
      const uint at = sampled_at + atomicAdd(parts[kHeadSampled], slices);
      uint slice = 0u;
      do {
        scratch[at + slice] = sampledEntry((item - items_at) / kItemWords, slice, slices);
        ++slice;
      } while (slice < slices);
    }
  }
}

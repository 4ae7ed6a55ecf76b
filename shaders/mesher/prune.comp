#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require

// Prunes a field program to up to 64 boxes, one per invocation. field/prune.h explains the method, and why pruning does
// not change any bit of a sample in the box. A forward pass computes the bounds of all records. A backward pass then
// writes the list of those that stay, starting at its end.

layout(local_size_x_id = 0) in;

#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/items.glsl"
#include "mesher/tape.glsl"
#include "op_numbers.glsl"
#include "common/common.h"
#include "mesher/box.glsl"
#include "common/bounds.h"

const uint kEndOfWindow = 0xFFu;
const uint kMaxRecords = 1024u;

float mark[kMaxRecords];   // for each record: the value that decides whether it stays
float whole_mark[kMaxRecords];
float layer_add[64], layer_cut[64], layer_joined[64], layer_replaced[64];
float nearest_high[64];     // for each slot: upper bound of the nearest operand of the round union that is stored in
                            // this slot

#define MARK(value) mark[record_number] = value;
#define MARK_WHOLE(value) whole_mark[record_number] = value;
#define MARK_LAYER(layer, joined_low, replaces)      \
  layer_add[layer] = add_high;                       \
  layer_cut[layer] = cut_high;                       \
  layer_joined[layer] = joined_low;                  \
  layer_replaced[layer] = replaces ? 1.0f : 0.0f;
#include "mesher/bound_forms.glsl"

// Returns the bit of a slot in a mask. The last slot (kFarSlot), which contains a constant far value, has no bit,
// because no record computes it.
uvec2 bitOf(uint slot) {
  const uint bit = 1u << (slot & 31u);
  return uvec2(slot < 32u ? bit : 0u, slot >= 32u && slot < kFarSlot ? bit : 0u);
}

// Reads the records from..end of the program into the window, as far as they fit; returns the first record that did not
// fit.
uint fillWindow(uint headers, uint from, uint end) {
  const uint lane = gl_SubgroupInvocationID & 7u;
  uint filled = 0u, at = from, base = from, piece = 0u;
  bool fits = true;
  do {
    const uvec4 eight = batch_fours[headers + base + lane];
    do {
      const uint pieces = subgroupShuffle(eight.x, at - base) >> 16;
      fits = fits && (piece > 0u || filled + pieces + 1u < kWindow);
      if (fits) window[filled] = batch_fours[(subgroupShuffle(eight.z, at - base) + piece) * 8u + lane];
      filled += fits ? 1u : 0u;
      piece = piece + 1u < pieces ? piece + 1u : 0u;
      at += fits && piece == 0u ? 1u : 0u;
    } while (fits && at < min(base + 8u, end));
    base += 8u;
  } while (fits && at < end);
  window[filled] = uvec4(kEndOfWindow);
  return at;
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

  // The box of a brick is extended by one sample on each side. So if a brick is uniform, no edge that leaves it changes
  // sign.
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
  setSlot(kFarSlot, makeBounds(kMaxBound, kMaxBound));
  place_low[0] = lo;
  place_high[0] = hi;

  Bounds field = makeBounds(initial, initial);
  Bounds adds = makeBounds(kNever, kNever), cuts = makeBounds(kNever, kNever);
  float add_high = field.hi, cut_high = kNever;
  record_number = 0u;
  uint next = 0u;
  if (records > 0u) do {
    next = fillWindow(headers, next, records);
#include "mesher/sweep.glsl"
  } while (next < records);

  const bool solid = field.hi * scale < -0.55f, empty = field.lo * scale > -0.45f;
  const uint list_end = batch[job + kJobLists] + (which + 1u) * records;
  uint begin = list_end;
  uvec2 live = uvec2(0u);  // mask of the slots whose values are needed
  uint live_places = 0u;
  // replaced: the current layer replaces the layers below it; below: a higher layer does so, so this one has no effect
  bool below = false, replaced = false;
  float limit_add = 0.0f, limit_cut = 0.0f, limit_joined = 0.0f;
  const bool listed = used && (!bricks || !(solid || empty));
  uint r = records;
  const uint lane = gl_SubgroupInvocationID & 7u;
  if (records > 0u) do {
    const uint from = (r - 1u) & ~7u;
    const uvec4 eight = batch_fours[headers + from + lane];
    do {
      --r;
      const uint head_word = subgroupShuffle(eight.x, r & 7u), slots_word = subgroupShuffle(eight.y, r & 7u);
      const uint record_place = subgroupShuffle(eight.z, r & 7u), traits = subgroupShuffle(eight.w, r & 7u);
      const uint dst = slots_word & 0xFFu, ra = slots_word >> 8 & 0xFFu, rb = slots_word >> 16 & 0xFFu;
      const uint rc = slots_word >> 24;
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
      const uvec2 made = bitOf(dst), second = bitOf(rb);
      const bool dst_live =
          (traits & kMakesPlace) != 0u ? (live_places >> dst & 1u) != 0u : (live & made) != uvec2(0u);
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

      // The records are visited backwards, and `live` marks the slots whose values are needed later. Before this
      // record, the old value of the slot that the record writes is not needed; the values of its operands are.
      if (keep && is_op && (traits & (kAddsTo | kMakesPlace)) == 0u) {
        live &= ~made;
        if ((traits & kBeginsTwo) != 0u) live &= ~second;
      }
      if (keep && (traits & kMakesPlace) != 0u) live_places &= ~(1u << dst);
      const uint operands = traits & kOperands;
      const bool chooses = is_op && choice != kKept;
      const bool read_a = keep && operands > 0u && !(chooses && choice == kSecondAlone);
      const bool read_b = keep && (operands > 1u || (traits & kAddsTo) != 0u) && !(chooses && choice == kFirstAlone);
      const bool read_c = keep && operands > 2u && !chooses;
      if (read_a) live |= bitOf(ra);
      if (read_b) live |= second;
      if (read_c) live |= bitOf(rc);
      const bool at_place = (traits & (kReadsPosition | kMakesPlace)) != 0u && !(chooses && choice == kFirstAlone);
      if (keep && at_place) live_places |= 1u << place;
      if (emit && listed) {
        --begin;
        scratch[begin] = record_place | choice << 30;
      }
    } while (r > from);
  } while (r > 0u);

  if (used) {
    const uint item = bricks ? brickItem(chunk_number, which) : planeItem(seam_number, kind_of_job - 1u);
    scratch[item + kItemList] = begin;
    scratch[item + kItemCount] = list_end - begin;
    scratch[item + kItemFlags] = (solid ? kItemSolid : 0u) | (empty ? kItemEmpty : 0u);
    // If a layer replaces everything below it, the field starts with a far value instead of the domain's initial value.
    scratch[item + kItemInitial] = below || replaced ? floatBitsToUint(1.0e30f) : batch[job + kJobInitial];
    scratch[item + kItemLabel] = below || replaced ? 0u : batch[job + kJobLabel];
    scratch[item + kItemScale] = batch[job + kJobScale];
    scratch[item + kItemOwner] = bricks ? chunk : seam;
    // for a sampled item, refine.comp replaces this word
    scratch[item + kItemParts] = (solid ? 0xFFu : 0u) | (empty ? 0xFF00u : 0u);
    // If only seams are requested, only the bricks at the seams' faces are sampled.
    const uint faces = batch[chunk + kChunkFaces];
    const uvec3 at_low = uvec3(equal(firstOfBrick(which), uvec3(0u))), at_high = uvec3(equal(lastOfBrick(which), uvec3(32u)));
    const uint touched = at_low.x | at_high.x << 1 | at_low.y << 2 | at_high.y << 3 | at_low.z << 4 | at_high.z << 5;
    const bool wanted = kind_of_job == 2u || faces == 0u || (faces & touched) != 0u;
    if (!(solid || empty) && kind_of_job != 1u && wanted) {
      const uint passes = 729u / (4u * gl_WorkGroupSize.x) + 8u;
      const uint slices = min(passes * roundsOf(list_end - begin) / kMaxRounds + 1u, kMaxSlices);
      const uint at = sampled_at + atomicAdd(parts[kHeadSampled], slices);
      uint slice = 0u;
      do {
        scratch[at + slice] = sampledEntry((item - items_at) / kItemWords, slice, slices);
        ++slice;
      } while (slice < slices);
    }
  }
}

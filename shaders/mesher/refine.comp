#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require

// Finds out which of the eight parts of a brick that will be sampled are uniform: one invocation per part, one
// workgroup per brick. About half of the parts are uniform, and need no samples.

layout(local_size_x_id = 0) in;

#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/items.glsl"
#include "mesher/tape.glsl"
#include "op_numbers.glsl"
#include "mesher/window.glsl"
#include "common/common.h"
#include "mesher/box.glsl"
#include "common/bounds.h"

#define MARK(value) {}
#define MARK_WHOLE(value) {}
#define MARK_LAYER(layer, joined_low, replaces) {}
#include "mesher/bound_forms.glsl"

void main() {
  const uint entry = scratch[sampled_at + gl_WorkGroupID.x];
  const uint number = itemOfEntry(entry);
  const uint item = items_at + kItemWords * number;
  const bool brick = number < chunk_count * kBricks;
  // A brick may be listed several times, once per slice, so only the entry of its first slice tests its parts.
  const bool asked = brick && sliceOfEntry(entry) == 0u;
  const uint list = scratch[item + kItemList], list_end = list + (asked ? scratch[item + kItemCount] : 0u);
  const float scale = uintBitsToFloat(scratch[item + kItemScale]);
  const float initial = uintBitsToFloat(scratch[item + kItemInitial]);
  const uint owner = scratch[item + kItemOwner];
  const uint chunk = brick ? owner : kChunkWords * batch[owner + kSeamChunk];
  const int cell = int(batch[chunk + kChunkCell]);
  const ivec3 origin =
      ivec3(batch[chunk + kChunkOrigin], batch[chunk + kChunkOrigin + 1u], batch[chunk + kChunkOrigin + 2u]);
  const uint which = gl_LocalInvocationID.x & 7u;
  const ivec3 first = ivec3(firstOfPart(number % kBricks, which)), last = ivec3(lastOfPart(number % kBricks, which));
  // As for bricks, the box is extended by one sample on each side.
  const ivec3 lo = origin + max(first - 1, ivec3(0)) * cell, hi = origin + min(last + 1, ivec3(32)) * cell;
  setSlot(kFarSlot, makeBounds(kMaxBound, kMaxBound));
  place_low[0] = lo;
  place_high[0] = hi;

  Bounds field = makeBounds(initial, initial);
  Bounds adds = makeBounds(kNever, kNever), cuts = makeBounds(kNever, kNever);
  float add_high = field.hi, cut_high = kNever;
  uint next = list;
  do {
    next = fillWindow(next, list_end);
#include "mesher/sweep.glsl"
  } while (next < list_end);

  field = layerJoined(field, adds, cuts);
  const uint solid = subgroupBallot(field.hi * scale < -0.55f).x & 0xFFu;
  const uint empty = subgroupBallot(field.lo * scale > -0.45f).x & 0xFFu;
  if (gl_LocalInvocationID.x == 0u && asked) {
    scratch[item + kItemParts] = solid | empty << 8;
  }
}

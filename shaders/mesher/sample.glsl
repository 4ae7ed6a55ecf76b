// Computes the samples and signs of one item per workgroup: of a brick that is not proven uniform, or of the coarse
// plane of a seam.

layout(local_size_x_id = 0) in;

#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/items.glsl"
#include "mesher/tape.glsl"
#include "op_numbers.glsl"
#include "mesher/window.glsl"
#include "common/common.h"
#include "mesher/addend.glsl"

const uint kEach = 4u;  // number of samples that one invocation evaluates together

float slots[kSlots * kEach];
ivec3 warped[7u * kEach];

Dual valueOf(float v) { return makeDual(v, 0.0f, 0.0f, 0.0f, 0); }

int movedBy(int at, float w) {
  PRECISE Real m = clampReal(w, -1048576.0f, 1048576.0f) * 1024.0f;
  m = m + 0.5f;
  return at + toInt(floorReal(m));
}

float folded(float field, float own, float width, bool cut) {
  Dual f = valueOf(field), g = valueOf(own);
  return cut ? roundCut(f, g, width).v : roundUnion(f, g, width).v;
}

void main() {
  const uint entry = scratch[sampled_at + gl_WorkGroupID.x];
  const uint item = items_at + kItemWords * itemOfEntry(entry);
  const uint list = scratch[item + kItemList], list_end = list + scratch[item + kItemCount];
  const float initial = uintBitsToFloat(scratch[item + kItemInitial]);
  const float scale = uintBitsToFloat(scratch[item + kItemScale]);
  const uint owner = scratch[item + kItemOwner];
  const uint number = (item - items_at) / kItemWords;
  const bool plane = number >= chunk_count * kBricks;
  const uint chunk = plane ? kChunkWords * batch[owner + kSeamChunk] : owner;
  const int cell = int(batch[chunk + kChunkCell]);
  ivec3 origin = ivec3(batch[chunk + kChunkOrigin], batch[chunk + kChunkOrigin + 1u], batch[chunk + kChunkOrigin + 2u]);
  const uint samples = plane ? batch[owner + kSeamSamples] : batch[chunk + kChunkSamples];
  const uint signs = plane ? batch[owner + kSeamSigns] : batch[chunk + kChunkSigns];
  const uint face = plane ? batch[owner + kSeamFace] : 0u;
  const uint axis = face >> 1;
  // mask of the brick's parts that are uniform and need no samples; a plane is a single part
  const uint uniform_parts = scratch[item + kItemParts];
  uint left = plane ? 1u : ~(uniform_parts | uniform_parts >> 8) & 0xFFu;

  for (uint s = 0u; s < kEach; ++s) slots[kFarSlot * kEach + s] = farAway().v;
  uint filled_to = fillWindow(list, list_end);
  const bool whole = filled_to == list_end;
  uint part = uint(findLSB(left)), base = sliceOfEntry(entry) * kEach * gl_WorkGroupSize.x;
  if (left != 0u) do {
    const uvec3 first = firstOfPart(number % kBricks, part);
    const uvec3 extent = lastOfPart(number % kBricks, part) - first + 1u;
    const uint count = plane ? kCoarseSide * kCoarseSide : extent.x * extent.y * extent.z;
    // 65536 / 4 or 65536 / 5, rounded up: multiplication by it and a shift by 16 bits replace a division
    const uvec3 inverse = mix(uvec3(13108u), uvec3(16384u), equal(extent, uvec3(4u)));
    int px[kEach], py[kEach], pz[kEach];
    float field[kEach], cuts[kEach];
    uint target[kEach], word[kEach];
    uint bit[kEach];
    bool inside[kEach];
    for (uint s = 0u; s < kEach; ++s) {
      uint i = base + s * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
      inside[s] = i < count;
      i = min(i, count - 1u);
      const uint row = i * inverse.x >> 16, z = row * inverse.y >> 16;
      uvec3 at = first + uvec3(i - row * extent.x, row - z * extent.y, z);
      uint b = i * 3856u >> 16, a = i - b * kCoarseSide;  // i * 3856 >> 16 divides by 17, exactly for the 289 samples
      ivec3 on_plane = ivec3(0);
      on_plane[axis] = (face & 1u) != 0u ? 32 : 0;
      on_plane[(axis + 1u) % 3u] = int(2u * a);
      on_plane[(axis + 2u) % 3u] = int(2u * b);
      ivec3 p = origin + (plane ? on_plane : ivec3(at)) * cell;
      px[s] = p.x;
      py[s] = p.y;
      pz[s] = p.z;
      uint sign_row = at.y + kSide * at.z;
      target[s] = samples + (plane ? i : at.x + kSide * sign_row);
      word[s] = signs + (plane ? b : 2u * sign_row + (at.x >> 5));
      bit[s] = plane ? a : at.x & 31u;
      field[s] = initial;
      cuts[s] = 1.0e30f;
    }
    uint next = list;
    do {
      if (!whole) filled_to = fillWindow(next, list_end);
      next = filled_to;

#define EACH(BODY)                                                                                     \
  { const uint s = 0u; BODY } { const uint s = 1u; BODY } { const uint s = 2u; BODY } { const uint s = 3u; BODY }
#define MOVED (OCCURS(kOp_warp) && place != 0u)
#define PX (MOVED ? warped[(place - 1u) * kEach + s].x : px[s])
#define PY (MOVED ? warped[(place - 1u) * kEach + s].y : py[s])
#define PZ (MOVED ? warped[(place - 1u) * kEach + s].z : pz[s])
#define SLOT(r) slots[(r) * kEach + s]
#define READ(r) valueOf(SLOT(r))
#define FORM_CONSTANT(F) EACH(SLOT(dst) = F(P).v;)
#define FORM_POSITION(F) EACH(SLOT(dst) = opMinimum(READ(ra), F(PX, PY, PZ, P)).v;)
// Noise is evaluated for one sample at a time, because its loop over octaves already uses the processor well.
#define OF_SAMPLE(p) (s == 0u ? p[0] : s == 1u ? p[1] : s == 2u ? p[2] : p[3])
#define FORM_NOISE(F)                                                                                  \
  uint s = 0u;                                                                                         \
  do {                                                                                                 \
    ivec3 at = ivec3(OF_SAMPLE(px), OF_SAMPLE(py), OF_SAMPLE(pz));                                     \
    if (MOVED) at = warped[(place - 1u) * kEach + s];                                                  \
    SLOT(dst) = F(at.x, at.y, at.z, P).v;                                                              \
    ++s;                                                                                               \
  } while (s < kEach);
#define FORM_POSITION_1(F) EACH(SLOT(dst) = F(PX, PY, PZ, READ(ra), P).v;)
#define READ_JOINED                                                                                    \
  float a[kEach], b[kEach], c[kEach], made[kEach];                                                     \
  EACH(a[s] = SLOT(ra); b[s] = SLOT(rb); c[s] = PF(P, kByWord); made[s] = a[s];                          \
       if (kHasThird) c[s] = HOW(P, kHowByConstant) ? c[s] : SLOT(rc);)
#define WRITE_JOINED EACH(SLOT(dst) = made[s];)
#define FORM_UNARY(F) EACH(made[s] = F(valueOf(a[s])).v;)
#define FORM_UNARY_P(F) EACH(made[s] = F(valueOf(a[s]), P).v;)
#define FORM_BINARY(F) EACH(made[s] = F(valueOf(a[s]), valueOf(b[s])).v;)
#define FORM_TERNARY(F) EACH(made[s] = F(valueOf(a[s]), valueOf(b[s]), valueOf(c[s])).v;)
#define FORM_COPY(F)
#define FORM_ROUND_BEGIN(F) EACH(SLOT(dst) = farAway().v; SLOT(rb) = nothing().v;)
#define FORM_ROUND_ADD(F)                                           \
  EACH(Dual d = READ(ra); SLOT(dst) = opMinimum(READ(dst), d).v;    \
       SLOT(rb) = roundAccumulate(READ(rb), d, PF(P, 0)).v;)
#define FORM_ROUND_END(F) EACH(SLOT(dst) = opRoundEnd(READ(ra), READ(rb), P).v;)
// The evaluation of attributes also tracks the operand of a sum with the largest weight, whose label the sum takes
// (attributes.glsl). Samples need no labels, so this operand is not tracked here.
#define FORM_SUM_BEGIN(F) EACH(SLOT(rb) = nothing().v;)
#define FORM_SUM_ADD(F) EACH(SLOT(rb) = opAdd(READ(rb), addend(READ(ra), READ(rc), P)).v;)
#define FORM_SUM_END(F) EACH(SLOT(dst) = opSumEnd(nothing(), READ(rb), P).v;)
#define FORM_WARP(F)                                                                                   \
  EACH(warped[(dst - 1u) * kEach + s] =                                                                \
           ivec3(movedBy(PX, SLOT(ra)), movedBy(PY, SLOT(rb)), movedBy(PZ, SLOT(rc)));)
#define WITHIN                                                                                         \
  ((flags & 2u) == 0u || (px[s] >= lo.x && py[s] >= lo.y && pz[s] >= lo.z && px[s] <= hi.x && py[s] <= hi.y && pz[s] <= hi.z))
#define INFLUENCE                                                                                      \
  const ivec3 lo = ivec3(PI(P, 0), PI(P, 1), PI(P, 2)), hi = ivec3(PI(P, 3), PI(P, 4), PI(P, 5));      \
  const uint flags = PU(P, 6);                                                                         \
  const bool cut = (flags & 1u) != 0u;
#define FORM_FOLD                                                                                      \
  INFLUENCE                                                                                            \
  const bool ends = (flags & kEndsLayer) != 0u;                                                        \
  EACH(bool within = WITHIN && !ends; Dual before = valueOf(cut ? cuts[s] : field[s]);                 \
       float after = opMinimum(before, READ(ra)).v;                                                    \
       float left = opCut(valueOf(field[s]), valueOf(cuts[s])).v;                                      \
       field[s] = ends ? left : within && !cut ? after : field[s];                                     \
       cuts[s] = ends ? 1.0e30f : within && cut ? after : cuts[s];)
#define FORM_SMOOTH                                                                                    \
  INFLUENCE                                                                                            \
  EACH(bool within = WITHIN; float after = folded(field[s], SLOT(ra), PF(P, 7), cut); if (within) field[s] = after;)
#include "mesher/sweep.glsl"
    } while (next < list_end);

    for (uint s = 0u; s < kEach; ++s) {
      int q = quantise(field[s], scale);
      bool solid = inside[s] && q < 0;
      if (inside[s]) scratch[target[s]] = uint(q);
      // Usually each invocation writes the signs of its own samples. If rows have four samples, the signs of four
      // successive invocations form one row, and the first of the four invocations writes them all.
      const bool alone = plane || extent.x != 4u;
      const uint lane = gl_SubgroupInvocationID;
      const uvec4 ballot = subgroupBallot(solid);
      const uint row_bits = (lane < 32u ? ballot.x : ballot.y) >> (lane & 28u) & 0xFu;
      const uint bits = alone ? (solid ? 1u << bit[s] : 0u) : (lane & 3u) == 0u ? row_bits << bit[s] : 0u;
      if (bits != 0u) atomicOr(scratch[word[s]], bits);
    }
    base += slicesOfEntry(entry) * kEach * gl_WorkGroupSize.x;
    if (base >= count) {
      base = sliceOfEntry(entry) * kEach * gl_WorkGroupSize.x;
      left &= left - 1u;
      part = uint(findLSB(left)) & 7u;
    }
  } while (left != 0u);
}

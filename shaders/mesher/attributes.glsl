// Computes normals, materials and tags of vertices. A workgroup processes the vertices of one brick, or those vertices
// of a seam that are evaluated with the field of one of its two levels. Also adds the vertices to the part's hash.

layout(local_size_x_id = 0) in;

#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/items.glsl"
#include "mesher/tape.glsl"
#include "op_numbers.glsl"
#include "mesher/window.glsl"
#include "common/common.h"
#include "mesher/addend.glsl"
#include "mesher/hash.glsl"

float slot_v[kSlots], slot_x[kSlots], slot_y[kSlots], slot_z[kSlots];
int slot_label[kSlots];
ivec3 warped[8];
mat3 jacobians[8];  // Jacobian of each warped position: column j contains d place / d sample_j

Dual readSlot(uint slot) { return makeDual(slot_v[slot], slot_x[slot], slot_y[slot], slot_z[slot], slot_label[slot]); }
void writeSlot(uint slot, Dual d) {
  slot_v[slot] = d.v;
  slot_x[slot] = d.x;
  slot_y[slot] = d.y;
  slot_z[slot] = d.z;
  slot_label[slot] = d.label;
}

// All `precise` arithmetic is in functions whose arguments are values, and must not read global arrays directly:
// glslang traces `precise` backwards through all assignments to such an array, which takes extremely long. Function
// calls end this search.
float alongColumn(Dual d, vec3 column) {
  PRECISE Real a = d.x * column.x;
  PRECISE Real b = d.y * column.y;
  PRECISE Real c = d.z * column.z;
  a = a + b;
  PRECISE Real r = a + c;
  return holdReal(r);
}
Dual byColumns(Dual d, mat3 j) {
  return makeDual(d.v, alongColumn(d, j[0]), alongColumn(d, j[1]), alongColumn(d, j[2]), d.label);
}
int movedBy(int at, float w) {
  PRECISE Real m = clampReal(w, -1048576.0f, 1048576.0f) * 1024.0f;
  m = m + 0.5f;
  return at + toInt(floorReal(m));
}
vec3 steepened(vec3 column, float x, float y, float z) {
  PRECISE Real a = x * 1024.0f;
  a = column.x + a;
  PRECISE Real b = y * 1024.0f;
  b = column.y + b;
  PRECISE Real c = z * 1024.0f;
  c = column.z + c;
  return vec3(holdReal(a), holdReal(b), holdReal(c));
}

// Converts a local coordinate from 1/256 of a cell to whole units (mesh/vertex.h).
int localUnits(uint at, int cell) { return int(at >> 8) * cell + ((int(at & 255u) * cell + 128) >> 8); }

void main() {
  const uvec4 unit = scratch_fours[units_at / kUnitWords + gl_WorkGroupID.x];
  const uint number = unit.x;
  const uint item = items_at + kItemWords * number;
  const uint owner = scratch[item + kItemOwner];
  const bool brick = number < chunk_count * kBricks;
  const uint chunk = brick ? owner : kChunkWords * batch[owner + kSeamChunk];
  const uint list = scratch[item + kItemList], list_end = list + scratch[item + kItemCount];
  const float initial = uintBitsToFloat(scratch[item + kItemInitial]);
  const int initial_label = int(scratch[item + kItemLabel]);
  const int cell = int(batch[chunk + kChunkCell]);
  const ivec3 origin =
      ivec3(batch[chunk + kChunkOrigin], batch[chunk + kChunkOrigin + 1u], batch[chunk + kChunkOrigin + 2u]);
  const uint part_number = brick ? batch[chunk + kChunkPart] : batch[owner + kSeamPart];
  const uint part = kHeadWords + kPartWords * (part_number == kNoRoom ? 0u : part_number);
  const uint first_vertex = parts[part + kPartFirstVertex];
  // The order of a seam's vertices: those on fine edges, then those on coarse edges, then lateral ones. Vertices on
  // coarse edges belong to the coarser level.
  const uint fine = parts[part + kPartCells], middle = parts[part + kPartMiddle];
  const bool coarse = ((number - chunk_count * kBricks) & 1u) == 1u;
  const uint count = unit.z;

  writeSlot(kFarSlot, farAway());
  uint filled_to = fillWindow(list, list_end);
  const bool whole = filled_to == list_end;
  uvec2 share = uvec2(0u);
  uint base = 0u;
  while (base < count) {
    const uint i = base + gl_LocalInvocationID.x;
    const bool used = i < count;
    const uint k = min(i, count - 1u);
    const uint at = unit.y + k;
    const uint of_seam = coarse ? fine + at : at < fine ? at : at + middle;
    const uint vertex = brick ? scratch[at] : first_vertex + of_seam;
    uvec4 packed_vertex = vertices[vertex];
    const ivec3 p = origin + ivec3(localUnits(packed_vertex.x & 0xFFFFu, cell), localUnits(packed_vertex.x >> 16, cell),
                                   localUnits(packed_vertex.y & 0xFFFFu, cell));
    warped[0] = p;
    jacobians[0] = mat3(1.0f);
    Dual field = makeDual(initial, 0.0f, 0.0f, 0.0f, initial_label);
    Dual cuts = farAway();
    uint next = list;
    do {
      if (!whole) filled_to = fillWindow(next, list_end);
      next = filled_to;

#define MOVED (OCCURS(kOp_warp) && place != 0u)
#define PX (MOVED ? warped[place].x : p.x)
#define PY (MOVED ? warped[place].y : p.y)
#define PZ (MOVED ? warped[place].z : p.z)

#define STORE(d)       \
  {                    \
    Dual made = (d);   \
    writeSlot(dst, made); \
  }
#define FORM_CONSTANT(F) STORE(F(P))
#define FORM_POSITION(F)                                                         \
  {                                                                              \
    Dual made = F(PX, PY, PZ, P);                                                \
    if (OCCURS(kOp_warp)) made = selDual(place == 0u, made, byColumns(made, jacobians[place])); \
    writeSlot(dst, opMinimum(readSlot(ra), made));                               \
  }
#define FORM_POSITION_1(F)                                                       \
  {                                                                              \
    Dual t = readSlot(ra);                                                       \
    Dual made = F(PX, PY, PZ, t, P);                                             \
    if (OCCURS(kOp_warp)) made = selDual(place == 0u, made, byColumns(made, jacobians[place])); \
    writeSlot(dst, addSlope(made, t, opPowerMorphSlope(PX, PY, PZ, t, P)));      \
  }
#define READ_JOINED                                   \
  const Dual a = readSlot(ra), b = readSlot(rb);      \
  Dual c = nothing(), made = a;                       \
  c.v = PF(P, kByWord);                               \
  if (kHasThird) c = selDual(HOW(P, kHowByConstant), c, readSlot(rc));
#define WRITE_JOINED writeSlot(dst, made);
#define FORM_UNARY(F) made = F(a);
#define FORM_UNARY_P(F) made = F(a, P);
#define FORM_BINARY(F) made = F(a, b);
#define FORM_TERNARY(F) made = F(a, b, c);
#define FORM_COPY(F)
#define FORM_ROUND_BEGIN(F)     \
  writeSlot(dst, farAway());    \
  writeSlot(rb, nothing());
#define FORM_ROUND_ADD(F)                                          \
  {                                                                \
    Dual d = readSlot(ra);                                         \
    writeSlot(dst, opMinimum(readSlot(dst), d));                   \
    writeSlot(rb, roundAccumulate(readSlot(rb), d, PF(P, 0)));     \
  }
#define FORM_ROUND_END(F) STORE(opRoundEnd(readSlot(ra), readSlot(rb), P))
#define FORM_SUM_BEGIN(F)       \
  writeSlot(dst, nothing());    \
  writeSlot(rb, nothing());
#define FORM_SUM_ADD(F)                                \
  {                                                    \
    Dual d = addend(readSlot(ra), readSlot(rc), P);    \
    writeSlot(dst, sumHeaviest(readSlot(dst), d));     \
    writeSlot(rb, opAdd(readSlot(rb), d));             \
  }
#define FORM_SUM_END(F) STORE(opSumEnd(readSlot(ra), readSlot(rb), P))
#define FORM_WARP(F)                                                                                         \
  {                                                                                                          \
    Dual wx = readSlot(ra), wy = readSlot(rb), wz = readSlot(rc);                                            \
    ivec3 from = warped[place];                                                                              \
    mat3 slopes = jacobians[place];                                                                          \
    warped[dst] = ivec3(movedBy(from.x, wx.v), movedBy(from.y, wy.v), movedBy(from.z, wz.v));                \
    jacobians[dst] = mat3(steepened(slopes[0], wx.x, wy.x, wz.x), steepened(slopes[1], wx.y, wy.y, wz.y),    \
                          steepened(slopes[2], wx.z, wy.z, wz.z));                                           \
  }
#define INFLUENCE                                                                                            \
  const ivec3 lo = ivec3(PI(P, 0), PI(P, 1), PI(P, 2)), hi = ivec3(PI(P, 3), PI(P, 4), PI(P, 5));            \
  const uint flags = PU(P, 6);                                                                               \
  const bool cut = (flags & 1u) != 0u;                                                                       \
  const bool within = (flags & 2u) == 0u || (all(greaterThanEqual(p, lo)) && all(lessThanEqual(p, hi)));
#define FORM_FOLD                                                                   \
  {                                                                                 \
    INFLUENCE                                                                       \
    Dual own = readSlot(ra);                                                        \
    const bool ends = (flags & kEndsLayer) != 0u;                                   \
    Dual left = opCut(field, cuts);                                                 \
    Dual merged = opMinimum(selDual(cut, cuts, field), own);                        \
    field = selDual(ends, left, selDual(within && !cut, merged, field));            \
    cuts = selDual(ends, farAway(), selDual(within && cut, merged, cuts));          \
  }
#define FORM_SMOOTH                                                                 \
  {                                                                                 \
    INFLUENCE                                                                       \
    Dual own = readSlot(ra);                                                        \
    Dual blended = selDual(cut, roundCut(field, own, PF(P, 7)), roundUnion(field, own, PF(P, 7))); \
    field = selDual(within, blended, field);                                        \
  }
#include "mesher/sweep.glsl"
    } while (next < list_end);

    const PackedNormal normal = packNormal(unsignedZero(field.x), unsignedZero(field.y), unsignedZero(field.z));
    const uint label = uint(field.label);
    packed_vertex.y = (packed_vertex.y & 0xFFFFu) | label << 16;
    packed_vertex.z = (uint(normal.x) & 0xFFFFu) | uint(normal.y) << 16;
    packed_vertex.w = (packed_vertex.w & 0xFFFF0000u) | label >> 16;
    if (used) {
      vertices[vertex] = packed_vertex;
      share += hashVertex(packed_vertex, vertex - first_vertex);
    }
    base += gl_WorkGroupSize.x;
  }
  share = subgroupAdd(share);
  if (subgroupElect() && count > 0u) {
    atomicAdd(parts[part + kPartHash], share.x);
    atomicAdd(parts[part + kPartHash + 1u], share.y);
  }
}

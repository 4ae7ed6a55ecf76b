#version 450
#extension GL_GOOGLE_include_directive : require
// Lists the active cells of all bodies that fit into the buffers: one workgroup per chunk, one invocation per row that
// has active cells.
layout(local_size_x = 64) in;
#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/edges.glsl"
#include "mesher/cells.glsl"

// Returns the number of triangles of a marching-cubes case (see census_body.comp).
uint trianglesOf(uint cell_case) {
  const uint kFaces[6] = uint[](0x55u, 0xAAu, 0x33u, 0xCCu, 0x0Fu, 0xF0u);
  uint count = bitCount(cell_case) + (cell_case == 0xFFu ? 4u : 0u);
  for (uint f = 0u; f < 6u; ++f) count -= (cell_case & kFaces[f]) == kFaces[f] ? 2u : 0u;
  uint hollow = ~cell_case & 0xFFu;
  return hollow == 0x81u || hollow == 0x42u || hollow == 0x24u || hollow == 0x18u ? count - 4u : count;
}

// Reads the signs of three rows, starting with row r. For rows beyond the chunk, the result is arbitrary, and the
// caller does not use it.
void readRows(uint signs, uint r, out uvec2 a, out uvec2 b, out uvec2 c) {
  uint pair = signs / 4u + min(r, kRows - 2u) / 2u;
  uvec4 low = scratch_fours[pair], high = scratch_fours[pair + 1u];
  bool odd = (r & 1u) != 0u;
  a = odd ? low.zw : low.xy;
  b = odd ? high.xy : low.zw;
  c = odd ? high.zw : high.xy;
}

void listRow(uint signs, uint rows, uint part, uint list, uint r) {
  uint y = r % kSide, z = r / kSide;
  uvec4 counts = scratch_fours[rows / kRowWords + r];
  uvec4 first = uvec4(counts.x, 0u, scratch[rows + (r + kSide) * kRowWords], 0u);
  uvec2 s00, s10, s20, s01, s11, s21, s02, s12, s22;
  readRows(signs, r, s00, s10, s20);
  readRows(signs, r + kSide, s01, s11, s21);
  readRows(signs, r + 2u * kSide, s02, s12, s22);
  RowEdges e00 = crossedEdges(s00, s10, s01, y, z), e10 = crossedEdges(s10, s20, s11, y + 1u, z);
  RowEdges e01 = crossedEdges(s01, s11, s02, y, z + 1u), e11 = crossedEdges(s11, s21, s12, y + 1u, z + 1u);
  first.y = first.x + verticesOf(e00);
  first.w = first.z + verticesOf(e01);
  uvec4 words = uvec4(s00.x, s10.x, s01.x, s11.x);
  uvec4 next_words = uvec4(shifted(s00), shifted(s10), shifted(s01), shifted(s11));
  uint index = counts.y, to = list / kCellWords + counts.z, live = counts.w;
  do {
    uint x = uint(findLSB(live));
    uvec4 corners = (words >> x & 1u) | (next_words >> x & 1u) << 1;
    ActiveCell cell;
    cell.cell_case = corners.x | corners.y << 2 | corners.z << 4 | corners.w << 6;
    cell.first = first;
    cell.first.xy += uvec2(verticesBefore(e00, x), verticesBefore(e10, x));
    cell.first.zw += uvec2(verticesBefore(e01, x), verticesBefore(e11, x));
    cell.owned = uvec3(ownedByTwo(e00, x), ownedByTwo(e10, x), ownedByTwo(e01, x));
    cell.index = index;
    cell.part = part;
    scratch_fours[to] = packCell(cell);
    index += 3u * trianglesOf(cell.cell_case);
    ++to;
    live &= live - 1u;
  } while (live != 0u);
}

void main() {
  uint chunk = gl_WorkGroupID.x * kChunkWords, part = batch[chunk + kChunkPart];
  if (part == kNoRoom) return;
  uint place = parts[kHeadWords + part * kPartWords + kPartMiddle];
  if (place == kNoRoom) return;
  uint signs = batch[chunk + kChunkSigns], rows = batch[chunk + kChunkRows];
  uint active_rows = scratch[rows + kActiveRows], i = gl_LocalInvocationIndex;
  do {
    if (i < active_rows) listRow(signs, rows, part, cell_list + place * kCellWords, scratch[rows + kActiveRowList + i]);
    i += gl_WorkGroupSize.x;
  } while (i < active_rows);
}

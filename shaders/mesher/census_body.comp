#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
// Counts the vertices, indices and active cells of a chunk's body from the samples' signs: one workgroup per chunk, one
// invocation per run of rows. An invocation processes its rows twice: first to count them all, then to store the counts
// before each row.
layout(local_size_x = 64) in;
#include "mesher/batch.glsl"
#include "mesher/edges.glsl"
#include "mesher/scan.glsl"

const uint kPairs = 545u;       // number of pairs of successive rows of samples in a chunk
const uint kPairsInRun = 9u;    // pairs of rows that each invocation processes; 64 invocations cover all pairs
const uint kPairsToPlane = 16u; // pair p + kPairsToPlane contains the neighbour, in the next plane (33 rows later), of
                                // the first row of pair p

// Returns the number of triangles in a row of cells, for 32 cells at once. The cells lie between the rows of samples a,
// b (next in y), c (next in z) and d (next in both). If a cell has E crossed edges in L loops, it has E - 2 L
// triangles. If n corners are solid, and e edges and f faces lie completely in the solid, E is 3 n - 2 e and, by
// Euler's formula, L is n - e + f; so the number is n - 2 f. Two cases differ: a ring around two opposite void corners
// has two loops more than the formula, and the solid cube two less.
uint trianglesOf(uint a, uint b, uint c, uint d, uint a1, uint b1, uint c1, uint d1) {
  uint low = a & b & c & d, high = a1 & b1 & c1 & d1;
  uint corners = bitCount(a) + bitCount(b) + bitCount(c) + bitCount(d) + bitCount(a1) + bitCount(b1) + bitCount(c1) +
                 bitCount(d1);
  uint faces = bitCount(low) + bitCount(high) + bitCount(a & c & a1 & c1) + bitCount(b & d & b1 & d1) +
               bitCount(a & b & a1 & b1) + bitCount(c & d & c1 & d1);
  uint ring = (b & c & d & a1 & b1 & c1 & ~(a | d1)) | (a & c & d & a1 & b1 & d1 & ~(b | c1)) |
              (a & b & d & a1 & c1 & d1 & ~(c | b1)) | (a & b & c & b1 & c1 & d1 & ~(d | a1));
  return corners + 4u * bitCount(low & high) - 2u * faces - 4u * bitCount(ring);
}

struct Row {
  uvec4 counts;  // numbers of vertices, indices and active cells; w: 1 if there are active cells
  uint live;
};

Row countRow(uint r, uvec2 a, uvec2 b, uvec2 c, uvec2 d) {
  uint y = r % kSide, z = r / kSide;
  if (r >= kRows) return Row(uvec4(0u), 0u);
  uint vertex_count = verticesOf(crossedEdges(a, b, c, y, z));
  if (y == kCells || z == kCells) return Row(uvec4(vertex_count, uvec3(0u)), 0u);
  uint a1 = shifted(a), b1 = shifted(b), c1 = shifted(c), d1 = shifted(d);
  uint live = (a.x | b.x | c.x | d.x | a1 | b1 | c1 | d1) & ~(a.x & b.x & c.x & d.x & a1 & b1 & c1 & d1);
  uint triangles = trianglesOf(a.x, b.x, c.x, d.x, a1, b1, c1, d1);
  return Row(uvec4(vertex_count, 3u * triangles, bitCount(live), min(live, 1u)), live);
}

// Returns the signs of a pair of rows. For a pair beyond the chunk, the caller does not use the result.
uvec4 signPair(uint signs, uint pair) { return scratch_fours[signs / 4u + min(pair, kPairs - 1u)]; }

void writeRow(uint rows, uint r, Row row, inout uvec4 before) {
  if (r < kRows) scratch_fours[rows / kRowWords + r] = uvec4(before.xyz, row.live);
  if (row.live != 0u) scratch[rows + kActiveRowList + before.w] = r;
  before += row.counts;
}

// Processes a run of rows, and adds their counts to `before`. If `write` is true, stores the counts before each row.
void walk(uint signs, uint rows, uint first, bool write, inout uvec4 before) {
  uvec4 here = signPair(signs, first), there = signPair(signs, first + kPairsToPlane);
  uint pair = first;
  do {
    uvec4 next = signPair(signs, pair + 1u), next_there = signPair(signs, pair + 1u + kPairsToPlane);
    uint r = 2u * pair;
    Row even = countRow(r, here.xy, here.zw, there.zw, next_there.xy);
    Row odd = countRow(r + 1u, here.zw, next.xy, next_there.xy, next_there.zw);
    if (write) {
      writeRow(rows, r, even, before);
      writeRow(rows, r + 1u, odd, before);
    } else {
      before += even.counts + odd.counts;
    }
    here = next;
    there = next_there;
    ++pair;
  } while (pair < first + kPairsInRun);
}

void main() {
  uint chunk = gl_WorkGroupID.x * kChunkWords, part = batch[chunk + kChunkPart];
  if (part == kNoRoom) return;
  uint signs = batch[chunk + kChunkSigns], rows = batch[chunk + kChunkRows];
  uint first = placeInWorkgroup() * kPairsInRun;
  uvec4 own = uvec4(0u), before, all;
  walk(signs, rows, first, false, own);
  scanWorkgroup(own, before, all);
  walk(signs, rows, first, true, before);
  if (gl_LocalInvocationIndex == 0u) {
    uint at = kHeadWords + part * kPartWords;
    parts[at + kPartVertices] = all.x;
    parts[at + kPartIndices] = all.y;
    parts[at + kPartCells] = all.z;
    parts[at + kPartMiddle] = kNoRoom;
    scratch[rows + kActiveRows] = all.w;
  }
}

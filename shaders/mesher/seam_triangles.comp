#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
// Writes the triangles of all seams that fit into the buffers: one workgroup per seam, one invocation per active cell.
// Requires that the positions of vertices are written. Loops have up to 12 points and are triangulated in the same way
// as by triangulateFlatLoop (mesh/triangulate_any.h).
layout(local_size_x = 32) in;
#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/edges.glsl"
#include "mesher/face.glsl"
#include "mesher/case_layout.h"
#include "mesher/hash.glsl"
#include "mesher/traverse.glsl"
#include "mesher/twelve_points.glsl"

const uint kEdges = 20u;

struct Seam {
  uint record, part, face, counts;
  uint first_vertex, first_index;
};

// Returns, for a row, the number of the first vertex on an edge that starts at sample `a` or a later one; and the
// crossed edges that start at samples a to a + 2, three bits each.
uvec2 numbersFrom(RowEdges e, uint start, uint a) {
  return uvec2(start + verticesBefore(e, a),
               ownedEdges(e, a) | ownedEdges(e, a + 1u) << 3 | (a + 2u <= kCells ? ownedEdges(e, a + 2u) << 6 : 0u));
}

// The numbers of the vertices on a cell's edges. Edges are numbered as in mesh/tables.h.
uint number[kEdges];

// Fills `number` for the cell at (a, b), and returns the cell's case.
uint numberEdges(Seam seam, uint a, uint b) {
  uint fine = (seam.counts + kSeamPlane) / 2u + 2u * b, signs = batch[seam.record + kSeamSigns] + b;
  uvec2 f0 = scratch_pairs[fine], f1 = scratch_pairs[fine + 1u];
  uvec2 f2 = scratch_pairs[fine + 2u], f3 = scratch_pairs[fine + 3u];
  uint c0 = scratch[signs], c1 = scratch[signs + 1u], c2 = scratch[signs + 2u];
  uint rows = seam.counts + kSeamFineRows + 2u * b, coarse_rows = seam.counts + kSeamCoarseRows + b;
  uint lateral_rows = seam.counts + kSeamLateralRows + b;
  uvec2 n0 = numbersFrom(fineEdges(f0, f1, 2u * b), scratch[rows], 2u * a);
  uvec2 n1 = numbersFrom(fineEdges(f1, f2, 2u * b + 1u), scratch[rows + 1u], 2u * a);
  uvec2 n2 = numbersFrom(fineEdges(f2, f3, 2u * b + 2u), scratch[rows + 2u], 2u * a);
  number[0] = vertexOnEdge(n0.x, n0.y, 0u);
  number[1] = vertexOnEdge(n0.x, n0.y, 3u);
  number[2] = vertexOnEdge(n1.x, n1.y, 0u);
  number[3] = vertexOnEdge(n1.x, n1.y, 3u);
  number[4] = vertexOnEdge(n2.x, n2.y, 0u);
  number[5] = vertexOnEdge(n2.x, n2.y, 3u);
  number[6] = vertexOnEdge(n0.x, n0.y, 1u);
  number[7] = vertexOnEdge(n0.x, n0.y, 4u);
  number[8] = vertexOnEdge(n0.x, n0.y, 7u);
  number[9] = vertexOnEdge(n1.x, n1.y, 1u);
  number[10] = vertexOnEdge(n1.x, n1.y, 4u);
  number[11] = vertexOnEdge(n1.x, n1.y, 7u);
  uvec2 m0 = numbersFrom(coarseEdges(c0, c1, b), scratch[coarse_rows], a);
  uvec2 m1 = numbersFrom(coarseEdges(c1, c2, b + 1u), scratch[coarse_rows + 1u], a);
  number[12] = vertexOnEdge(m0.x, m0.y, 0u);
  number[13] = vertexOnEdge(m1.x, m1.y, 0u);
  number[14] = vertexOnEdge(m0.x, m0.y, 1u);
  number[15] = vertexOnEdge(m0.x, m0.y, 4u);
  uint before = (1u << a) - 1u, through = 2u * before + 1u;
  uint l0 = lateralEdges(f0, c0), l1 = lateralEdges(f2, c1);
  uint start0 = scratch[lateral_rows], start1 = scratch[lateral_rows + 1u];
  number[16] = start0 + bitCount(l0 & before);
  number[17] = start0 + bitCount(l0 & through);
  number[18] = start1 + bitCount(l1 & before);
  number[19] = start1 + bitCount(l1 & through);
  return seamCase(f0, f1, f2, c0, c1, a);
}

uint byteOf(uint place) { return tables[kSeamBytes + place / 4u] >> (8u * (place % 4u)) & 255u; }

void writeTriangles(Seam seam, uint cell, inout uvec2 hash) {
  uint a = cell & 15u, b = cell >> 4 & 15u, index = 3u * (cell >> 8);
  uint entry = tables[kSeamCases + numberEdges(seam, a, b)];
  uint left = entry >> kSeamTrianglesShift, at = entry & ((1u << kSeamTrianglesShift) - 1u);
  uvec3 corner = pointOf(seam.face, 512u * a, 512u * b, kCells * 256u);
  do {
    uint n = byteOf(at), i = 0u;
    do {
      uint edge = byteOf(at + 1u + (i == 0u || isHigh(seam.face) ? i : n - i));
      uvec2 vertex = vertices[seam.first_vertex + number[edge]].xy;
      loop[i] = packPoint(uvec3(vertex.x & 0xFFFFu, vertex.x >> 16, vertex.y & 0xFFFFu) - corner,
                          tables[kSeamFaces + edge], number[edge]);
      ++i;
    } while (i < n);
    at += n + 1u;
    left -= n - 2u;
    cutLoop(n);
    Chords todo = wholeLoop(n);
    do {
      uint from = todo.from, to = endOfFirst(todo), apex = apexOf(chord[from * kLongestLoop + to]);
      uvec3 triangle = uvec3(vertexOf(loop[from]), vertexOf(loop[apex]), vertexOf(loop[to]));
      hash += hashIndex(triangle.x, index) + hashIndex(triangle.y, index + 1u) + hashIndex(triangle.z, index + 2u);
      indices[seam.first_index + index] = triangle.x;
      indices[seam.first_index + index + 1u] = triangle.y;
      indices[seam.first_index + index + 2u] = triangle.z;
      index += 3u;
      cutFirst(todo, apex);
    } while (anyLeft(todo));
  } while (left != 0u);
}

void main() {
  Seam seam;
  seam.record = seam_records + gl_WorkGroupID.x * kSeamWords;
  seam.part = batch[seam.record + kSeamPart];
  uvec4 part = part_fours[(kHeadWords + seam.part * kPartWords) / 4u];
  seam.first_vertex = part[kPartFirstVertex];
  seam.first_index = part[kPartFirstIndex];
  if (seam.first_vertex == kNoRoom) return;
  seam.face = batch[seam.record + kSeamFace];
  seam.counts = batch[seam.record + kSeamCounts];
  uint live = scratch[seam.counts + kSeamActive], i = gl_LocalInvocationIndex;
  uvec2 hash = uvec2(0u);
  do {
    if (i < live) writeTriangles(seam, scratch[seam.counts + kSeamCells + i], hash);
    i += gl_WorkGroupSize.x;
  } while (i < live);
  addHash(seam.part, hash);
}

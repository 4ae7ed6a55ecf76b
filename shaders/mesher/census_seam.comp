#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
// Counts the vertices and triangles of a seam from the samples' signs: one workgroup per seam. Also stores the signs of
// the chunk's own samples on the face, for later kernels.
layout(local_size_x = 64) in;
#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/edges.glsl"
#include "mesher/face.glsl"
#include "mesher/scan.glsl"
#include "mesher/case_layout.h"

const uint kCellsOfOne = 4u;  // number of adjacent cells along axis a that one invocation processes

shared uvec2 fine[kSide + 1u];         // signs of the fine rows, and one more row, whose edges are not used
shared uint coarse[kCoarseSide + 1u];

uvec2 rowOfPlane(Plane plane, uint signs, uint b) {
  uvec2 row = uvec2(0u);
  uint a = 0u;
  do {
    uint sample_number = plane.origin + a * plane.step_u + b * plane.step_v;
    uint x = sample_number % kSide, bit = scratch[signs + 2u * (sample_number / kSide) + x / 32u] >> (x % 32u) & 1u;
    if (a < 32u) row.x |= bit << a;
    else row.y = bit;
    ++a;
  } while (a < kSide);
  return row;
}

void main() {
  uint record = seam_records + gl_WorkGroupID.x * kSeamWords, counts = batch[record + kSeamCounts];
  uint i = placeInWorkgroup();
  if (i < kSide) {
    uint signs = batch[batch[record + kSeamChunk] * kChunkWords + kChunkSigns];
    fine[i] = rowOfPlane(planeOf(batch[record + kSeamFace]), signs, i);
    scratch_pairs[(counts + kSeamPlane) / 2u + i] = fine[i];
  }
  if (i < kCoarseSide) coarse[i] = scratch[batch[record + kSeamSigns] + i];
  barrier();

  // Counts of one invocation. x, y, z: numbers of vertices in its row: on edges of the fine level, on edges of the
  // coarse level, and on lateral edges (between the levels). w: number of triangles in its cells; from bit 16 on,
  // number of active cells.
  uvec4 own = uvec4(0u), before, sum;
  if (i < kSide) own.x = verticesOf(fineEdges(fine[i], fine[i + 1u], i));
  if (i < kCoarseSide) {
    own.y = verticesOf(coarseEdges(coarse[i], coarse[i + 1u], i));
    own.z = bitCount(lateralEdges(fine[2u * i], coarse[i]));
  }
  uint cell = i * kCellsOfOne, b = cell / 16u, triangles = 0u, k = 0u;
  uvec2 f0 = fine[2u * b], f1 = fine[2u * b + 1u], f2 = fine[2u * b + 2u];
  uint c0 = coarse[b], c1 = coarse[b + 1u];
  do {
    uint cell_case = seamCase(f0, f1, f2, c0, c1, cell % 16u + k);
    triangles |= tables[kSeamCases + cell_case] >> kSeamTrianglesShift << (8u * k);
    ++k;
  } while (k < kCellsOfOne);
  uvec4 each = uvec4(triangles, triangles >> 8, triangles >> 16, triangles >> 24) & 255u;
  own.w = each.x + each.y + each.z + each.w;
  each = min(each, uvec4(1u));
  own.w += (each.x + each.y + each.z + each.w) << 16;
  scanWorkgroup(own, before, sum);

  if (i < kSide) scratch[counts + kSeamFineRows + i] = before.x;
  if (i < kCoarseSide) {
    scratch[counts + kSeamCoarseRows + i] = sum.x + before.y;
    scratch[counts + kSeamLateralRows + i] = sum.x + sum.y + before.z;
  }
  uint to = counts + kSeamCells + (before.w >> 16), triangle = before.w & 0xFFFFu;
  k = 0u;
  do {
    uint count = triangles >> (8u * k) & 255u;
    if (count != 0u) scratch[to++] = (cell + k) | triangle << 8;
    triangle += count;
    ++k;
  } while (k < kCellsOfOne);
  if (i == 0u) {
    scratch[counts + kSeamActive] = sum.w >> 16;
    uint at = kHeadWords + batch[record + kSeamPart] * kPartWords;
    parts[at + kPartVertices] = sum.x + sum.y + sum.z;
    parts[at + kPartIndices] = 3u * (sum.w & 0xFFFFu);
    parts[at + kPartCells] = sum.x;
    parts[at + kPartMiddle] = sum.y;
  }
}

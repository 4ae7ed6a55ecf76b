#version 450
#extension GL_GOOGLE_include_directive : require
// Writes the positions and kinds of the vertices of all seams that fit into the buffers: one workgroup per seam, one
// invocation per row. Attributes are left 0.
layout(local_size_x = 64) in;
#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/edges.glsl"
#include "mesher/face.glsl"

const uint kSeamRows = 67u;  // number of rows: fine, coarse and lateral ones together

const uint kOwnEdge = 0u;  // values of VertexKind (mesh/chunk.h)
const uint kCoarserEdge = 1u;
const uint kLateralEdge = 2u;

struct Row {
  uint b, kind;
  uvec2 along_u, along_v;  // masks of the crossed edges along u and v
  uint samples;            // index in `scratch` of the row's first sample (a = 0)
  uint step_u, step_v;     // distances in `scratch` between neighbours along u and v
};

Row fineRow(uint chunk, uint face, uint counts, uint b) {
  uint at = (counts + kSeamPlane) / 2u + b;
  RowEdges e = fineEdges(scratch_pairs[at], scratch_pairs[at + 1u], b);
  Plane plane = planeOf(face);
  uint samples = batch[chunk + kChunkSamples] + plane.origin + b * plane.step_v;
  return Row(b, kOwnEdge, uvec2(e.x, 0u), e.y, samples, plane.step_u, plane.step_v);
}

Row coarseRow(uint record, uint b) {
  uint at = batch[record + kSeamSigns] + b;
  RowEdges e = coarseEdges(scratch[at], scratch[at + 1u], b);
  return Row(b, kCoarserEdge, uvec2(e.x, 0u), e.y, batch[record + kSeamSamples] + b * kCoarseSide, 1u, kCoarseSide);
}

Row lateralRow(uint record, uint counts, uint b) {
  uint signs = scratch[batch[record + kSeamSigns] + b];
  uvec2 fine = scratch_pairs[(counts + kSeamPlane) / 2u + 2u * b];
  return Row(b, kLateralEdge, uvec2(lateralEdges(fine, signs), 0u), uvec2(0u), 0u, 0u, 0u);
}

void writeRow(Row row, uint face, uint to) {
  uint step = row.kind == kOwnEdge ? 256u : 512u;
  uvec2 along_u = row.along_u, along_v = row.along_v;
  do {
    uvec2 owners = along_u | along_v;
    uint a = owners.x != 0u ? uint(findLSB(owners.x)) : 32u;
    bool is_u = a < 32u && (along_u.x >> a & 1u) != 0u;
    uvec2 bit = a < 32u ? uvec2(1u << a, 0u) : uvec2(0u, 1u);
    if (is_u) along_u &= ~bit;
    else along_v &= ~bit;
    uint from = row.samples + a * row.step_u, t = 0u;
    if (row.kind != kLateralEdge) {
      t = crossing(int(scratch[from]), int(scratch[from + (is_u ? row.step_u : row.step_v)])) * (step / 256u);
    }
    uvec3 at = pointOf(face, a * step + (is_u ? t : 0u), row.b * step + (is_u ? 0u : t), kCells * 256u);
    vertices[to] = uvec4(at.x | at.y << 16, at.z, 0u, row.kind << 16);
    ++to;
  } while ((along_u.x | along_v.x | along_v.y) != 0u);
}

void main() {
  uint record = seam_records + gl_WorkGroupID.x * kSeamWords;
  uint part = kHeadWords + batch[record + kSeamPart] * kPartWords, first = parts[part + kPartFirstVertex];
  if (first == kNoRoom) return;
  uint chunk = batch[record + kSeamChunk] * kChunkWords, face = batch[record + kSeamFace];
  uint counts = batch[record + kSeamCounts], i = gl_LocalInvocationIndex;
  do {
    if (i < kSeamRows) {
      Row row;
      if (i < kSeamCoarseRows) row = fineRow(chunk, face, counts, i);
      else if (i < kSeamLateralRows) row = coarseRow(record, i - kSeamCoarseRows);
      else row = lateralRow(record, counts, i - kSeamLateralRows);
      if ((row.along_u.x | row.along_v.x | row.along_v.y) != 0u) writeRow(row, face, first + scratch[counts + i]);
    }
    i += gl_WorkGroupSize.x;
  } while (i < kSeamRows);
}

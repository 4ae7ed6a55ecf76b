#version 450
#extension GL_GOOGLE_include_directive : require

// Divides the vertices of all seams that fit into the buffers into units, whose attributes a later pass computes. A
// seam has two planes, one per level; each invocation handles one plane. Vertices on fine edges and lateral vertices
// are evaluated with the chunk's own field, all others with the coarser level's.

layout(local_size_x_id = 0) in;

#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/items.glsl"

void main() {
  const uint seam = gl_WorkGroupID.x, coarse = gl_LocalInvocationID.x;
  if (coarse > 1u) return;
  const uint number = chunk_count * kBricks + 2u * seam + coarse;
  const uint part = kHeadWords + kPartWords * batch[seam_records + kSeamWords * seam + kSeamPart];
  const uint middle = parts[part + kPartMiddle];
  const uint wanted = coarse == 1u ? middle : parts[part + kPartVertices] - middle;
  const uint count = parts[part + kPartFirstVertex] == kNoRoom ? 0u : wanted;
  const uint most = verticesOfUnit(scratch[planeItem(seam, coarse) + kItemCount], gl_WorkGroupSize.x);
  uint unit = units_at / kUnitWords + atomicAdd(parts[kHeadUnits], (count + most - 1u) / most);
  uint from = 0u;
  while (from < count) {
    scratch_fours[unit] = uvec4(number, from, min(count - from, most), 0u);
    from += most;
    ++unit;
  }
}

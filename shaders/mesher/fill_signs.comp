#version 450
#extension GL_GOOGLE_include_directive : require

// The signs of all that is proven uniform, and zeros for the rest: a workgroup a chunk, then one a seam.

layout(local_size_x_id = 0) in;

#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/items.glsl"

void main() {
  const bool plane = gl_WorkGroupID.x >= chunk_count;
  const uint number = plane ? gl_WorkGroupID.x - chunk_count : gl_WorkGroupID.x;
  uint row = gl_LocalInvocationID.x;
  if (plane) {
    const uint seam = seam_records + kSeamWords * number;
    const bool solid = (scratch[planeItem(number, 1u) + kItemFlags] & kItemSolid) != 0u;
    while (row < kCoarseSide) {
      scratch[batch[seam + kSeamSigns] + row] = solid ? 0x1FFFFu : 0u;
      row += gl_WorkGroupSize.x;
    }
    return;
  }
  const uint signs = batch[kChunkWords * number + kChunkSigns];
  while (row < kRows) {
    const uint z = row / kSide, y = row - z * kSide;
    const uint first = 4u * min(y >> 3, 3u) + 16u * min(z >> 3, 3u);
    uint low = 0u, last = 0u;
    for (uint x = 0u; x < 4u; ++x) {
      last = scratch[brickItem(number, first + x) + kItemFlags] & kItemSolid;
      low |= last != 0u ? 0xFFu << (8u * x) : 0u;
    }
    scratch[signs + 2u * row] = low;
    scratch[signs + 2u * row + 1u] = last != 0u ? 1u : 0u;
    row += gl_WorkGroupSize.x;
  }
}

#version 450
#extension GL_GOOGLE_include_directive : require

// Fills the signs of a chunk before sampling: one workgroup per chunk, then one per seam. Boxes that are proven uniform
// get their sign; all others get zeroes.

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
    const uvec2 brick = min(uvec2(y, z) >> 3, uvec2(3u)), part = min(uvec2(y, z) >> 2, uvec2(7u)) & 1u;
    const uint first = 4u * brick.x + 16u * brick.y, first_part = 2u * part.x + 4u * part.y;
    uint low = 0u, last = 0u;
    for (uint x = 0u; x < 4u; ++x) {
      const uint solid = scratch[brickItem(number, first + x) + kItemParts] >> first_part & 3u;
      low |= ((solid & 1u) * 0x0Fu | (solid >> 1) * 0xF0u) << (8u * x);
      last = solid >> 1;
    }
    scratch[signs + 2u * row] = low;
    scratch[signs + 2u * row + 1u] = last;
    row += gl_WorkGroupSize.x;
  }
}

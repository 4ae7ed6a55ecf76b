#version 450
#extension GL_GOOGLE_include_directive : require
// Writes the positions of a body's vertices, with attributes of 0. One workgroup for each chunk, one invocation for
// each row.
layout(local_size_x = 64) in;
#include "mesher/batch.glsl"
#include "mesher/edges.glsl"

int sampleAt(uint samples, uvec3 at) { return int(scratch[samples + at.x + kSide * (at.y + kSide * at.z)]); }

void writeRow(uint chunk, uint first_vertex, uint r) {
  uint y = r % kSide, z = r / kSide, at = batch[chunk + kChunkSigns] / 2u + r, samples = batch[chunk + kChunkSamples];
  RowEdges e = crossedEdges(scratch_pairs[at], scratch_pairs[at + 1u], scratch_pairs[at + kSide], y, z);
  uint start = first_vertex + scratch[batch[chunk + kChunkRows] + r * kRowWords];
  for (uint x = 0u; x < kSide; ++x) {
    uint owned = ownedEdges(e, x), first = start + verticesBefore(e, x);
    for (uint axis = 0u; axis < 3u; ++axis) {
      if ((owned >> axis & 1u) == 0u) continue;
      uvec3 from = uvec3(x, y, z), to = from, place = 256u * from;
      to[axis] += 1u;
      place[axis] += crossing(sampleAt(samples, from), sampleAt(samples, to));
      vertices[vertexOnEdge(first, owned, axis)] = uvec4(place.x | place.y << 16, place.z, 0u, 0u);
    }
  }
}

void main() {
  uint chunk = gl_WorkGroupID.x * kChunkWords, part = batch[chunk + kChunkPart];
  if (part == kNoRoom) return;
  uint first = parts[kHeadWords + part * kPartWords + kPartFirstVertex];
  if (first == kNoRoom) return;
  for (uint r = gl_LocalInvocationIndex; r < kRows; r += gl_WorkGroupSize.x) writeRow(chunk, first, r);
}

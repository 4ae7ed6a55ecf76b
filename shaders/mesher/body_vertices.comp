#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require

// Writes the positions of bodies' vertices, and lists the vertices of each brick: one workgroup per brick that was
// sampled. A vertex lies on an edge that starts at a sample of its brick, so the brick's own pruned program is valid at
// the vertex.

layout(local_size_x_id = 0) in;

#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/items.glsl"
#include "mesher/edges.glsl"

shared uint brick_vertices;
shared uint brick_entries;

uvec2 signsOfRow(uint signs, uint row) { return scratch_pairs[signs / 2u + row]; }

// Returns a mask of the samples lo to hi of a row. x: one bit for each of the samples 0 to 31; y: bit 0 for sample 32.
uvec2 samplesOf(uint lo, uint hi) {
  uint upto = hi >= 31u ? 0xFFFFFFFFu : (2u << hi) - 1u;
  return uvec2(upto & ~((1u << lo) - 1u), hi == 32u ? 1u : 0u);
}

void main() {
  const uint entry = scratch[sampled_at + gl_WorkGroupID.x];
  const uint number = itemOfEntry(entry);
  const bool brick = number < chunk_count * kBricks && sliceOfEntry(entry) == 0u;
  const uint item = items_at + kItemWords * number;
  const uint chunk_number = min(number / kBricks, chunk_count - 1u);
  const uint chunk = kChunkWords * chunk_number;
  const uint body = batch[chunk + kChunkPart];
  const uint part = kHeadWords + kPartWords * (body == kNoRoom ? 0u : body);
  const uint first_vertex = parts[part + kPartFirstVertex];
  const bool wanted = brick && body != kNoRoom && first_vertex != kNoRoom;
  const uint signs = batch[chunk + kChunkSigns], samples = batch[chunk + kChunkSamples];
  const uint rows_at = batch[chunk + kChunkRows];
  const uvec3 first = firstOfBrick(number % kBricks), last = lastOfBrick(number % kBricks);
  const uvec2 inside = samplesOf(first.x, last.x);
  const uint height = last.y - first.y + 1u, rows = height * (last.z - first.z + 1u);

  uint counted = 0u;
  uint i = gl_LocalInvocationID.x;
  while (wanted && i < rows) {
    const uint y = first.y + i % height, z = first.z + i / height, row = y + kSide * z;
    const RowEdges e = crossedEdges(signsOfRow(signs, row), signsOfRow(signs, min(row + 1u, kRows - 1u)),
                                    signsOfRow(signs, min(row + kSide, kRows - 1u)), y, z);
    counted += bitCount(e.x & inside.x) + bitsOf(e.y & inside) + bitsOf(e.z & inside);
    i += gl_WorkGroupSize.x;
  }
  if (gl_LocalInvocationID.x == 0u) brick_vertices = 0u;
  barrier();
  uint at = counted > 0u ? atomicAdd(brick_vertices, counted) : 0u;
  barrier();
  if (gl_LocalInvocationID.x == 0u) {
    brick_entries = vertices_at + atomicAdd(parts[kHeadEntries], brick_vertices);
    const uint most = verticesOfUnit(scratch[item + kItemCount], gl_WorkGroupSize.x);
    uint unit = units_at / kUnitWords + atomicAdd(parts[kHeadUnits], (brick_vertices + most - 1u) / most);
    uint from = 0u;
    while (from < brick_vertices) {
      scratch_fours[unit] = uvec4(number, brick_entries + from, min(brick_vertices - from, most), 0u);
      from += most;
      ++unit;
    }
  }
  barrier();
  at += brick_entries;

  i = gl_LocalInvocationID.x;
  while (wanted && i < rows) {
    const uint y = first.y + i % height, z = first.z + i / height, row = y + kSide * z;
    const RowEdges e = crossedEdges(signsOfRow(signs, row), signsOfRow(signs, min(row + 1u, kRows - 1u)),
                                    signsOfRow(signs, min(row + kSide, kRows - 1u)), y, z);
    uvec2 owners = (uvec2(e.x, 0u) | e.y | e.z) & inside;
    const uint row_vertices = first_vertex + scratch[rows_at + kRowWords * row];
    while ((owners.x | owners.y) != 0u) {
      const uint x = owners.x != 0u ? uint(findLSB(owners.x)) : 32u;
      owners = owners.x != 0u ? uvec2(owners.x & (owners.x - 1u), owners.y) : uvec2(0u);
      const uint owned = ownedEdges(e, x);
      const uint before = row_vertices + verticesBefore(e, x);
      const uint sample0 = samples + x + kSide * row;
      const int q0 = int(scratch[sample0]);
      for (uint axis = 0u; axis < 3u; ++axis) {
        if ((owned >> axis & 1u) != 0u) {
          const uint step = axis == 0u ? 1u : axis == 1u ? kSide : kRows;
          const uint t = crossing(q0, int(scratch[sample0 + step]));
          const uvec3 place = 256u * uvec3(x, y, z) + uvec3(axis == 0u ? t : 0u, axis == 1u ? t : 0u, axis == 2u ? t : 0u);
          const uint vertex = vertexOnEdge(before, owned, axis);
          vertices[vertex] = uvec4(place.x | place.y << 16, place.z, 0u, 0u);
          scratch[at] = vertex;
          ++at;
        }
      }
    }
    i += gl_WorkGroupSize.x;
  }
}

#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
// Allocates space in the output buffers for each part (body or seam), one after the other, in one workgroup. If a part
// does not fit, neither that part nor the following ones get space.
layout(local_size_x = 64) in;
#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"
#include "mesher/scan.glsl"

const uint kMaxGroups = 65535u;  // number of workgroups that every Vulkan device can dispatch
const uint kGroupCells = 64u;    // number of active cells per workgroup of triangles.comp

shared uint used_vertices, used_indices, used_cells;

// Returns the numbers of vertices, indices and active cells that a part needs. Only bodies have active cells; a body is
// recognised by kPartMiddle = kNoRoom.
uvec4 wanted(uvec4 counts, uvec4 ends) { return uvec4(counts.xy, ends.w == kNoRoom ? ends.z : 0u, 0u); }

void main() {
  if (gl_LocalInvocationIndex == 0u) used_vertices = used_indices = used_cells = 0u;
  uint run = (part_count + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
  uint first = min(placeInWorkgroup() * run, part_count), end = min(first + run, part_count);
  uvec4 own = uvec4(0u), before, sum;
  for (uint part = first; part < end; ++part) {
    uint at = (kHeadWords + part * kPartWords) / 4u;
    own += wanted(part_fours[at], part_fours[at + 1u]);
  }
  scanWorkgroup(own, before, sum);
  uvec4 room = uvec4(max_vertices, max_indices, max_cells, 0u), used = uvec4(0u);
  for (uint part = first; part < end; ++part) {
    uint at = (kHeadWords + part * kPartWords) / 4u;
    uvec4 counts = part_fours[at], ends = part_fours[at + 1u], after = before + wanted(counts, ends);
    bool fits = all(lessThanEqual(after, room));
    uint middle = ends.w == kNoRoom && fits ? before.z : ends.w;
    part_fours[at] = uvec4(counts.xy, fits ? before.xy : uvec2(kNoRoom));
    part_fours[at + 1u] = uvec4(0u, 0u, ends.z, middle);
    used = fits ? after : used;
    before = after;
  }
  atomicMax(used_vertices, used.x);
  atomicMax(used_indices, used.y);
  atomicMax(used_cells, used.z);
  barrier();
  if (gl_LocalInvocationIndex == 0u) {
    parts[kHeadDispatch] = min((used_cells + kGroupCells - 1u) / kGroupCells, kMaxGroups);
    parts[kHeadDispatch + 1u] = 1u;
    parts[kHeadDispatch + 2u] = 1u;
    parts[kHeadCells] = used_cells;
    parts[kHeadVertices] = used_vertices;
    parts[kHeadIndices] = used_indices;
  }
}

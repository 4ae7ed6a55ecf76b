#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
// Adds the vertices' share to the hash of a part; one workgroup for each part.
layout(local_size_x = 64) in;
#include "mesher/batch.glsl"
#include "mesher/hash.glsl"

void main() {
  uint part = gl_WorkGroupID.x, at = kHeadWords + part * kPartWords, first = parts[at + kPartFirstVertex];
  if (first == kNoRoom) return;
  uvec2 hash = uvec2(0u);
  for (uint i = gl_LocalInvocationIndex; i < parts[at + kPartVertices]; i += gl_WorkGroupSize.x)
    hash += hashVertex(vertices[first + i], i);
  addHash(part, hash);
}

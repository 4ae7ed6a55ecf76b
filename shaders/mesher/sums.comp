#version 450
#extension GL_GOOGLE_include_directive : require
// Computes the sums over the triangles of all parts that fit into the buffers, as defined in mesh/part_sums.h: several
// workgroups per part, one invocation per triangle. Requires that the triangles are written. 64-bit numbers are stored
// as a low and a high word.
layout(local_size_x = 64) in;
#include "mesher/batch.glsl"
#include "mesher/sizes.glsl"

const uint kSums = 5u;  // number of sums: twice the area, three components of the cross product, six times the volume
shared uvec2 shares[kSums * gl_WorkGroupSize.x];

uvec2 add(uvec2 a, uvec2 b) {
  uint carry, low = uaddCarry(a.x, b.x, carry);
  return uvec2(low, a.y + b.y + carry);
}

uvec2 subtract(uvec2 a, uvec2 b) {
  uint borrow, low = usubBorrow(a.x, b.x, borrow);
  return uvec2(low, a.y - b.y - borrow);
}

uvec2 widen(int a) { return uvec2(a, a >> 31); }

uvec2 multiply(int a, int b) {
  int high, low;
  imulExtended(a, b, high, low);
  return uvec2(low, high);
}

uvec2 square(uint a) {
  uint high, low;
  umulExtended(a, a, high, low);
  return uvec2(low, high);
}

uvec2 shiftLeft(uvec2 a, uint bits) { return bits == 0u ? a : uvec2(a.x << bits, a.y << bits | a.x >> (32u - bits)); }

bool isAbove(uvec2 a, uvec2 b) { return a.y > b.y || (a.y == b.y && a.x > b.x); }

float toFloat(uvec2 a) { return float(a.y) * 4294967296.0 + float(a.x); }

// Returns the square root, rounded to the nearest integer, for x < 2^62.
uint roundedRoot(uvec2 x) {
  // The first guess may be inexact on some devices; the loops that follow find the exact root.
  uint root = uint(min(sqrt(toFloat(x)), 2147483520.0));
  if (root > 0u) {
    uvec2 squared = square(root);
    bool above = isAbove(squared, x);
    uint off = uint(toFloat(above ? subtract(squared, x) : subtract(x, squared)) / (2.0 * float(root)));
    root = above ? root - min(off, root) : root + off;
  }
  while (isAbove(square(root), x)) --root;
  while (!isAbove(square(root + 1u), x)) ++root;
  return root + (subtract(x, square(root)).x > root ? 1u : 0u);
}

// Returns the square root of an integer in 1/4096, with the same bits as fixedRoot of mesh/triangle_terms.h.
uvec2 fixedRoot(uvec2 squared) {
  const uint kLengthBits = 12u;
  uint bits = squared.y < 1u << 6 ? kLengthBits : squared.y < 1u << 18 ? kLengthBits / 2u : 0u;
  return shiftLeft(uvec2(roundedRoot(shiftLeft(squared, 2u * bits)), 0u), kLengthBits - bits);
}

ivec3 placeOf(uint vertex) {
  uvec2 words = vertices[vertex].xy;
  return ivec3(bitfieldExtract(int(words.x), 0, 16), int(words.x) >> 16, bitfieldExtract(int(words.y), 0, 16));
}

void main() {
  uint part = gl_WorkGroupID.x, at = kHeadWords + part * kPartWords, lane = gl_LocalInvocationIndex;
  uint triangles = parts[at + kPartIndices] / 3u;
  uint first_vertex = parts[at + kPartFirstVertex], first_index = parts[at + kPartFirstIndex];
  if (first_vertex == kNoRoom) return;
  uvec2 sums[kSums] = uvec2[](uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u));
  for (uint i = gl_WorkGroupID.y * gl_WorkGroupSize.x + lane; i < triangles;
       i += gl_NumWorkGroups.y * gl_WorkGroupSize.x) {
    uint corner = first_index + 3u * i;
    ivec3 a = placeOf(first_vertex + indices[corner]);
    ivec3 u = placeOf(first_vertex + indices[corner + 1u]) - a, v = placeOf(first_vertex + indices[corner + 2u]) - a;
    ivec3 c = ivec3(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    uvec3 sizes = uvec3(abs(c));
    sums[0] = add(sums[0], fixedRoot(add(add(square(sizes.x), square(sizes.y)), square(sizes.z))));
    sums[1] = add(sums[1], widen(c.x));
    sums[2] = add(sums[2], widen(c.y));
    sums[3] = add(sums[3], widen(c.z));
    sums[4] = add(sums[4], add(add(multiply(a.x, c.x), multiply(a.y, c.y)), multiply(a.z, c.z)));
  }
  for (uint k = 0u; k < kSums; ++k) shares[k * gl_WorkGroupSize.x + lane] = sums[k];
  barrier();
  if (lane >= kSums) return;
  uvec2 sum = uvec2(0u);
  for (uint i = 0u; i < gl_WorkGroupSize.x; ++i) sum = add(sum, shares[lane * gl_WorkGroupSize.x + i]);
  // If adding to the low word overflows, the same invocation adds the carry to the high word, so the order of additions
  // does not matter.
  uint place = kHeadWords + part_count * kPartWords + part * kSumWords + 2u * lane;
  uint before = atomicAdd(parts[place], sum.x);
  atomicAdd(parts[place + 1u], sum.y + (before + sum.x < before ? 1u : 0u));
}

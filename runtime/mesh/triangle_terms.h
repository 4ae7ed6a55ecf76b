#pragma once
// The contribution of one packed triangle to the sums over a mesh, in integers alone. So the result is equal on every
// backend and machine, in any order of addition. The CUDA kernels compile this source; Vulkan has a copy
// (shaders/mesher/sums.comp). Lengths are in 1/256 of the chunk's cell.

#include <cmath>
#include <cstdint>

#include "base/kernel.h"
#include "mesh/chunk.h"

namespace sgm {

/// The allowed positions of measured vertices on each axis: feature vertices may lie slightly more than a cell beyond
/// the chunk.
inline constexpr int kLeastPosition = -2 * kSubcell, kMaxPosition = kChunkCells * kSubcell + 2 * kSubcell;

/// A direction in integers: components are below 2^15 in magnitude, and their absolute values sum to 32767.
struct PackedDirection {
  int16_t x, y, z;
};

/// Unpacks the octahedral normal as unpackNormal does (mesh/vertex.h), but does not normalise it.
SGM_KERNEL PackedDirection unfoldNormal(int32_t x, int32_t y) {
  const int32_t ax = x < 0 ? -x : x, ay = y < 0 ? -y : y, z = 32767 - ax - ay;
  const int32_t folded_x = x < 0 ? ay - 32767 : 32767 - ay, folded_y = y < 0 ? ax - 32767 : 32767 - ax;
  return {static_cast<int16_t>(z < 0 ? folded_x : x), static_cast<int16_t>(z < 0 ? folded_y : y),
          static_cast<int16_t>(z)};
}

/// The square root, rounded to the nearest integer. 0 <= x < 2^62.
SGM_KERNEL int64_t roundedRoot(int64_t x) {
  // Computed in double, the root may be off by one in either direction.
  const auto root = static_cast<int64_t>(std::sqrt(static_cast<double>(x)) + 0.5);
  const int64_t square = root * root;
  return root + (x > square + root ? 1 : 0) - (x <= square - root && root != 0 ? 1 : 0);
}

inline constexpr int kLengthBits = 12;

/// Returns sqrt(square) in 1/4096, rounded to nearest. Below 2^38, which includes all triangles of a few cells, the
/// error is at most 1/8192.
SGM_KERNEL int64_t fixedRoot(int64_t square) {
  const int bits = square < int64_t{1} << 38 ? kLengthBits : square < int64_t{1} << 50 ? kLengthBits / 2 : 0;
  return roundedRoot(square << 2 * bits) << (kLengthBits - bits);
}

struct TriangleTerms {
  int32_t x, y, z;      ///< cross product of two sides: twice the area, along the normal
  int64_t square;       ///< the square of that cross product's length
  uint32_t sides;       ///< sum of the three squared side lengths
  int64_t six_volumes;  ///< six times the signed volume of the tetrahedron between the triangle and the chunk's origin
};

/// Precondition: all coordinates are in kLeastPosition..kMaxPosition.
SGM_KERNEL TriangleTerms termsOf(const Vertex& a, const Vertex& b, const Vertex& c) {
  const int32_t ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const int32_t vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const int32_t wx = vx - ux, wy = vy - uy, wz = vz - uz;
  TriangleTerms t;
  t.x = uy * vz - uz * vy;
  t.y = uz * vx - ux * vz;
  t.z = ux * vy - uy * vx;
  t.square = int64_t{t.x} * t.x + int64_t{t.y} * t.y + int64_t{t.z} * t.z;
  t.sides = static_cast<uint32_t>(ux * ux + uy * uy + uz * uz) + static_cast<uint32_t>(vx * vx + vy * vy + vz * vz) +
            static_cast<uint32_t>(wx * wx + wy * wy + wz * wz);
  t.six_volumes = int64_t{a.x} * t.x + int64_t{a.y} * t.y + int64_t{a.z} * t.z;
  return t;
}

/// True if the quality, 4 sqrt(3) area / sum of squared sides, is below 0.05 (kSliver in mesh_measures.h). Equivalent
/// to 4800 square < sides^2.
SGM_KERNEL bool isSliver(const TriangleTerms& t) {
  // Both sides of the inequality are divided by 64, so that the products fit into 64 bits.
  return 75 * t.square < (int64_t{t.sides} * t.sides + 63) >> 6;
}

/// The sums over triangles.
struct TermSums {
  int64_t area = 0;  ///< sum of twice the areas, in 1/4096 (fixedRoot)
  int64_t x = 0, y = 0, z = 0, six_volumes = 0;
  uint32_t slivers = 0;
};

SGM_KERNEL void addTerms(const TriangleTerms& t, TermSums& sums) {
  sums.area += fixedRoot(t.square);
  sums.x += t.x;
  sums.y += t.y;
  sums.z += t.z;
  sums.six_volumes += t.six_volumes;
  sums.slivers += isSliver(t) ? 1u : 0u;
}

/// True if the triangle faces in the direction of the sum of its corners' normals. a, b, c: these normals.
SGM_KERNEL bool facesAlong(const TriangleTerms& t, const PackedDirection& a, const PackedDirection& b,
                           const PackedDirection& c) {
  return int64_t{t.x} * (a.x + b.x + c.x) + int64_t{t.y} * (a.y + b.y + c.y) + int64_t{t.z} * (a.z + b.z + c.z) > 0;
}

}  // namespace sgm

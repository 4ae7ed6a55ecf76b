#pragma once
// The position and the normal of a packed vertex.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "base/kernel.h"
#include "mesh/chunk.h"

namespace sgm {

/// Returns the position, in 1/256 of an edge, at which the surface crosses it: 1..255. q0, q1: the samples at the lower
/// and the higher end on the edge's axis; their signs differ, so that the sum is not 0. Computes round(256 |q0| / (|q0|
/// + |q1|)), halves up, in 32-bit integers.
SGM_KERNEL uint32_t crossing(int32_t q0, int32_t q1) {
  const uint32_t a = static_cast<uint32_t>(std::abs(q0)), sum = a + static_cast<uint32_t>(std::abs(q1));
  const uint32_t t = (512 * a + sum) / (2 * sum);
  return t < 1 ? 1 : t > 255 ? 255 : t;
}

/// Converts a local position in 1/256 of a cell to whole units: round(position * cell / 256), halves up. 32 bits
/// suffice for a cell of at most 2^22 units. All chunks that share a vertex get the same result, at any level, since
/// its exact position is the same.
SGM_KERNEL int32_t localUnits(int32_t position, int32_t cell) {
  return (position >> 8) * cell + (((position & 255) * cell + 128) >> 8);
}

/// Returns the position of a vertex of a body or seam in world units, rounded as in localUnits. The vertex's attributes
/// are evaluated there.
SGM_KERNEL Int3 vertexUnits(const ChunkGrid& grid, const Vertex& v) {
  return {grid.origin.x + localUnits(v.x, grid.cell), grid.origin.y + localUnits(v.y, grid.cell),
          grid.origin.z + localUnits(v.z, grid.cell)};
}

/// The crossed edge that a body's vertex lies on: the sample at the edge's lower end, and the edge's axis. A vertex
/// never lies on a sample, so exactly one of its coordinates has a fraction: that coordinate's axis is the edge's axis.
/// Not for seams: there, the vertex keys contain the edges.
struct SampleEdge {
  int x, y, z, axis;
  size_t sample() const { return static_cast<size_t>(x + kChunkSamples * (y + kChunkSamples * z)); }
};
inline SampleEdge edgeOfBodyVertex(const Vertex& v) {
  return {v.x >> 8, v.y >> 8, v.z >> 8, (v.x & 255) != 0 ? 0 : (v.y & 255) != 0 ? 1 : 2};
}

/// Unpacks the octahedral normal to a direction of length one.
inline std::array<double, 3> unpackNormal(int16_t packed_x, int16_t packed_y) {
  double x = packed_x / 32767.0, y = packed_y / 32767.0;
  const double z = 1 - std::fabs(x) - std::fabs(y);
  if (z < 0) {
    const double folded_x = (1 - std::fabs(y)) * (x < 0 ? -1 : 1);
    y = (1 - std::fabs(x)) * (y < 0 ? -1 : 1);
    x = folded_x;
  }
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

/// Packs a non-zero direction of any length as an octahedral normal.
inline std::array<int16_t, 2> packNormal(const std::array<double, 3>& n) {
  const double sum = std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]);
  double x = n[0] / sum, y = n[1] / sum;
  if (n[2] < 0) {
    const double folded_x = (1 - std::fabs(y)) * (x < 0 ? -1 : 1);
    y = (1 - std::fabs(x)) * (y < 0 ? -1 : 1);
    x = folded_x;
  }
  return {static_cast<int16_t>(std::floor(x * 32767 + 0.5)), static_cast<int16_t>(std::floor(y * 32767 + 0.5))};
}

}  // namespace sgm

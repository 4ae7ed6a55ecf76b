#pragma once
// Fields for tests of meshing: a quantised value at every lattice point, as a pure function of seed, level and point.

#include <cstdint>
#include <functional>

#include "base/hash.h"
#include "mesh/body.h"
#include "mesh/seam.h"

namespace sgm::test {

/// Distance in units between lattice points of the finest level.
inline constexpr int32_t kSpacing = 8;

/// The quantised value (q) at a lattice point, as sampled at a level of detail.
using LatticeField = std::function<int32_t(Int3 point, int level)>;

inline uint64_t pointHash(uint64_t seed, Int3 p) {
  const auto part = [](int32_t v) { return static_cast<uint64_t>(static_cast<uint32_t>(v)); };
  return hashCombine(hashCombine(seed, part(p.x) << 32 | part(p.y)), part(p.z));
}

/// A quantised value of random size, which is solid with the probability `density`.
inline int32_t randomQ(uint64_t hash, double density) {
  const auto size = static_cast<int32_t>(hash >> 8 & (kMaxQ - 1));
  return PathKey{hash}.unit(1) < density ? -1 - size : size;
}

inline ChunkGrid latticeChunk(Int3 origin, int level) {
  return {{origin.x * kSpacing, origin.y * kSpacing, origin.z * kSpacing}, kSpacing << level, level};
}

inline Int3 latticeOrigin(const ChunkGrid& grid) {
  return {grid.origin.x / kSpacing, grid.origin.y / kSpacing, grid.origin.z / kSpacing};
}

inline ChunkSamples sampleChunk(const LatticeField& field, const ChunkGrid& grid) {
  ChunkSamples samples;
  const Int3 o = latticeOrigin(grid);
  const int32_t step = 1 << grid.level;
  size_t i = 0;
  for (int32_t z = 0; z < kChunkSamples; ++z) {
    for (int32_t y = 0; y < kChunkSamples; ++y) {
      uint64_t& row = samples.signs[static_cast<size_t>(y + z * kChunkSamples)];
      for (int32_t x = 0; x < kChunkSamples; ++x, ++i) {
        samples.q[i] = field({o.x + x * step, o.y + y * step, o.z + z * step}, grid.level);
        row |= uint64_t{samples.q[i] < 0} << x;
      }
    }
  }
  return samples;
}

inline CoarseFace sampleFace(const LatticeField& field, const ChunkGrid& grid, Face face) {
  CoarseFace coarse;
  for (int b = 0; b < kCoarseSamples; ++b) {
    for (int a = 0; a < kCoarseSamples; ++a) {
      const Int3 p = coarseFacePoint(grid, face, a, b);
      const int32_t q = field({p.x / kSpacing, p.y / kSpacing, p.z / kSpacing}, grid.level + 1);
      coarse.q[static_cast<size_t>(a + b * kCoarseSamples)] = q;
      coarse.signs[static_cast<size_t>(b)] |= static_cast<uint32_t>(q < 0) << a;
    }
  }
  return coarse;
}

}  // namespace sgm::test

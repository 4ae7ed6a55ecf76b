#pragma once
// Vertex keys packed for sorting, each with the index of its vertex.

#include <cstdint>

#include "mesh/chunk.h"

namespace sgm {

/// A packed vertex key with the index of its vertex. Ordered by key (in an order different from VertexKey's), then by
/// index.
struct OrderedKey {
  uint64_t high, low;
  uint32_t place;

  OrderedKey(const VertexKey& key, uint32_t at)
      : high(pack(key.corner.z, static_cast<uint32_t>(key.corner.y))),
        low(pack(key.corner.x, uint32_t{key.level} << 16 | uint32_t{key.axis} << 8 | key.fan)),
        place(at) {}

  bool sameKey(const OrderedKey& other) const { return high == other.high && low == other.low; }
  friend auto operator<=>(const OrderedKey&, const OrderedKey&) = default;

 private:
  static uint64_t pack(int32_t a, uint32_t b) { return uint64_t{static_cast<uint32_t>(a)} << 32 | b; }
};

}  // namespace sgm

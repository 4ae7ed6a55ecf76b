#pragma once
// The triangles of one loop of marching cubes, as exact tests take them.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "mesh/body_loops.h"
#include "mesh/triangle_faults.h"

namespace sgm {

inline constexpr uint32_t kFaceVertices = 1u << 30,
                          kCellVertices = 1u << 31;  ///< names of feature vertices start there

/// A box of places in 1/256 of a cell.
struct PlaceBox {
  Int3 lo{INT32_MAX, INT32_MAX, INT32_MAX}, hi{INT32_MIN, INT32_MIN, INT32_MIN};

  void take(const Int3& p) {
    for (int k = 0; k < 3; ++k) lo[k] = std::min(lo[k], p[k]), hi[k] = std::max(hi[k], p[k]);
  }
  bool meets(const PlaceBox& other) const {
    for (int k = 0; k < 3; ++k)
      if (lo[k] > other.hi[k] || other.lo[k] > hi[k]) return false;
    return true;
  }
};

struct NamedTriangle {
  std::array<Int3, 3> at;
  std::array<uint32_t, 3> name{};  ///< of vertices: equal for those that are one
  PlaceBox box;

  bool hasArea() const { return IntegerSigns::seenAlong(at) >= 0; }
  bool meets(const NamedTriangle& other) const {
    if (!box.meets(other.box)) return false;
    std::array<Int3, 3> a = at, b = other.at;
    std::array<uint32_t, 3> names_a = name, names_b = other.name;
    int common = 0;
    for (size_t i = 0; i < 3; ++i) {
      for (auto j = static_cast<size_t>(common); j < 3; ++j) {
        if (names_a[i] != names_b[j]) continue;
        const auto first = static_cast<size_t>(common);
        std::swap(b[first], b[j]), std::swap(names_b[first], names_b[j]);
        std::swap(a[first], a[i]), std::swap(names_a[first], names_a[i]);
        ++common;
        break;
      }
    }
    return TrianglePair<IntegerSigns>::faultOf(a, b, common) != PairFault::none;
  }
};

/// The triangles of one loop.
struct LoopTriangles {
  static constexpr size_t kMost = 2 * kLongestCubeLoop;

  std::array<NamedTriangle, kMost> store;
  uint32_t count = 0;
  PlaceBox box;

  void add(const std::array<Int3, 3>& at, const std::array<uint32_t, 3>& name) {
    NamedTriangle& triangle = store[count++];
    triangle = {at, name, {}};
    for (const Int3& p : at) triangle.box.take(p), box.take(p);
  }
  std::span<const NamedTriangle> all() const { return {store.data(), count}; }
};

inline Int3 placeOf(const MeshPart& part, uint32_t v) {
  return {part.vertices[v].x, part.vertices[v].y, part.vertices[v].z};
}

/// As meshed.
inline LoopTriangles plainTriangles(const MeshPart& part, const SurfaceLoop& loop) {
  LoopTriangles triangles;
  for (uint32_t i = loop.first_index; i < loop.end_index; i += 3) {
    const uint32_t* v = &part.indices[i];
    triangles.add({placeOf(part, v[0]), placeOf(part, v[1]), placeOf(part, v[2])}, {v[0], v[1], v[2]});
  }
  return triangles;
}

inline bool anyMeets(const LoopTriangles& first, const LoopTriangles& second) {
  if (!first.box.meets(second.box)) return false;
  for (const NamedTriangle& a : first.all()) {
    if (!a.box.meets(second.box)) continue;
    for (const NamedTriangle& b : second.all())
      if (a.meets(b)) return true;
  }
  return false;
}

}  // namespace sgm

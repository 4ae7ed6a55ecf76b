#pragma once
// The triangles of one marching-cubes loop, with or without features, in the form that the exact intersection tests
// need.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "mesh/body_loops.h"
#include "mesh/triangle_faults.h"

namespace sgm {

inline constexpr uint32_t kFaceVertices = 1u << 30,
                          /// NamedTriangle::name: face vertices have names from kFaceVertices on, cell vertices have
                          /// names from kCellVertices on; smaller names are indices of a part's vertices.
    kCellVertices = 1u << 31;

/// A box of positions in 1/256 of a cell.
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
  std::array<uint32_t, 3> name{};  ///< names of the corners: equal if the corners are the same vertex

  bool hasArea() const { return IntegerSigns::seenAlong(at) >= 0; }
  bool meets(const NamedTriangle& other) const {
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
class LoopTriangles {
 public:
  /// The maximum number of triangles. A fan has one triangle for each point of the polygon around its centre; each side
  /// of the loop contributes one vertex and up to two face vertices to this polygon.
  static constexpr size_t kMost = 3 * kLongestBodyLoop;

  LoopTriangles() = default;
  LoopTriangles(const LoopTriangles& other) { *this = other; }
  LoopTriangles& operator=(const LoopTriangles& other) {
    count_ = other.count_;
    std::copy_n(other.store_.triangles.begin(), count_, store_.triangles.begin());
    return *this;
  }

  void add(const std::array<Int3, 3>& at, const std::array<uint32_t, 3>& name) {
    store_.triangles[count_++] = {at, name};
  }
  size_t count() const { return count_; }
  std::span<const NamedTriangle> all() const { return {store_.triangles.data(), count_}; }
  std::span<NamedTriangle> all() { return {store_.triangles.data(), count_}; }

 private:
  /// A union, so that the triangles are not initialised: most loops have few triangles, and initialising kMost would
  /// cost time.
  union Store {
    std::array<NamedTriangle, kMost> triangles;
    Store() {}  // NOLINT(modernize-use-equals-default): that would be deleted
  };

  Store store_;
  uint32_t count_ = 0;
};

inline Int3 placeOf(const MeshPart& part, uint32_t v) {
  return {part.vertices[v].x, part.vertices[v].y, part.vertices[v].z};
}

/// Returns the triangles that marching cubes made for a loop.
inline LoopTriangles plainTriangles(const MeshPart& part, const SurfaceLoop& loop) {
  LoopTriangles triangles;
  for (uint32_t i = loop.first_index; i < loop.end_index; i += 3) {
    const uint32_t* v = &part.indices[i];
    triangles.add({placeOf(part, v[0]), placeOf(part, v[1]), placeOf(part, v[2])}, {v[0], v[1], v[2]});
  }
  return triangles;
}

/// Triangles with a bounding box for each triangle and one around all of them.
struct BoxedTriangles {
  std::span<const NamedTriangle> triangles;
  std::span<const PlaceBox> boxes;
  PlaceBox box;
};

inline PlaceBox boxOf(const NamedTriangle& triangle) {
  PlaceBox box;
  for (const Int3& p : triangle.at) box.take(p);
  return box;
}

inline bool anyMeets(const BoxedTriangles& first, const BoxedTriangles& second) {
  if (!first.box.meets(second.box)) return false;
  for (size_t i = 0; i < first.triangles.size(); ++i) {
    if (!first.boxes[i].meets(second.box)) continue;
    for (size_t j = 0; j < second.triangles.size(); ++j)
      if (first.boxes[i].meets(second.boxes[j]) && first.triangles[i].meets(second.triangles[j])) return true;
  }
  return false;
}

inline bool anyMeets(const LoopTriangles& first, const LoopTriangles& second) {
  struct Boxes {
    std::array<PlaceBox, LoopTriangles::kMost> of;
    PlaceBox all;
    explicit Boxes(const LoopTriangles& triangles) {
      for (size_t i = 0; i < triangles.count(); ++i) {
        of[i] = boxOf(triangles.all()[i]);
        all.take(of[i].lo), all.take(of[i].hi);
      }
    }
  };
  const Boxes a(first), b(second);
  return anyMeets(BoxedTriangles{first.all(), {a.of.data(), first.count()}, a.all},
                  BoxedTriangles{second.all(), {b.of.data(), second.count()}, b.all});
}

}  // namespace sgm

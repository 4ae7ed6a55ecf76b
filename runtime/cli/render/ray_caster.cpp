#include "render/ray_caster.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace sgm {
namespace {

constexpr size_t kLeafTriangles = 8;

// Puts the triangles of the lower half along the widest axis first, then does the same within each half: node i of the
// heap then holds a run of `leaves * kLeafTriangles` triangles. Ties go by number, so that the order is always the
// same.
void halve(std::span<uint32_t> order, size_t leaves, std::span<const glm::vec3> centres) {
  const size_t half = leaves / 2 * kLeafTriangles;
  if (leaves < 2 || order.size() <= kLeafTriangles) return;
  if (order.size() > half) {
    glm::vec3 lo{1e30f}, hi{-1e30f};
    for (uint32_t t : order) {
      lo = glm::min(lo, centres[t]);
      hi = glm::max(hi, centres[t]);
    }
    const glm::vec3 size = hi - lo;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::ranges::nth_element(order, order.begin() + static_cast<std::ptrdiff_t>(half), [&](uint32_t a, uint32_t b) {
      const float ca = centres[a][axis], cb = centres[b][axis];
      return ca != cb ? ca < cb : a < b;
    });
    halve(order.subspan(half), leaves / 2, centres);
  }
  halve(order.first(std::min(half, order.size())), leaves / 2, centres);
}

// Entry distance of the ray into the box, or a negative number where it misses or the box lies beyond `limit`.
inline float entry(const glm::vec3& lo, const glm::vec3& hi, const glm::vec3& from, const glm::vec3& inverse,
                   float limit) {
  const float ax = (lo.x - from.x) * inverse.x, bx = (hi.x - from.x) * inverse.x;
  const float ay = (lo.y - from.y) * inverse.y, by = (hi.y - from.y) * inverse.y;
  const float az = (lo.z - from.z) * inverse.z, bz = (hi.z - from.z) * inverse.z;
  const float enter = std::max(std::max(std::min(ax, bx), std::min(ay, by)), std::max(std::min(az, bz), 0.0f));
  const float leave = std::min(std::min(std::max(ax, bx), std::max(ay, by)), std::min(std::max(az, bz), limit));
  return enter <= leave ? enter : -1.0f;
}

}  // namespace

RayCaster::RayCaster(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                     std::pmr::memory_resource* memory)
    : vertices_(vertices), indices_(indices), order_(memory), nodes_(memory) {
  const size_t count = indices.size() / 3;
  order_.resize(count);
  std::pmr::vector<glm::vec3> centres(count, memory);
  for (uint32_t t = 0; t < count; ++t) {
    order_[t] = t;
    centres[t] = (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0f;
  }
  while (leaves_ * kLeafTriangles < count) leaves_ *= 2;
  nodes_.resize(2 * leaves_ - 1);
  halve(order_, leaves_, centres);
  for (size_t i = 0; i < count; ++i) {
    Node& leaf = nodes_[leaves_ - 1 + i / kLeafTriangles];
    for (int c = 0; c < 3; ++c) {
      leaf.lo = glm::min(leaf.lo, corner(order_[i], c));
      leaf.hi = glm::max(leaf.hi, corner(order_[i], c));
    }
  }
  for (size_t i = leaves_ - 1; i-- > 0;) {
    nodes_[i].lo = glm::min(nodes_[2 * i + 1].lo, nodes_[2 * i + 2].lo);
    nodes_[i].hi = glm::max(nodes_[2 * i + 1].hi, nodes_[2 * i + 2].hi);
  }
}

glm::vec3 RayCaster::facing(uint32_t triangle) const {
  return glm::cross(corner(triangle, 1) - corner(triangle, 0), corner(triangle, 2) - corner(triangle, 0));
}

// Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection" (1997).
void RayCaster::meet(uint32_t triangle, glm::vec3 from, glm::vec3 direction, std::optional<RayHit>& nearest,
                     float& limit) const {
  const glm::vec3 a = corner(triangle, 0), ab = corner(triangle, 1) - a, ac = corner(triangle, 2) - a;
  const glm::vec3 across = glm::cross(direction, ac);
  const float det = glm::dot(ab, across);
  if (det == 0) return;
  const glm::vec3 to_ray = from - a;
  const float u = glm::dot(to_ray, across) / det;
  if (u < 0 || u > 1) return;
  const glm::vec3 other = glm::cross(to_ray, ab);
  const float v = glm::dot(direction, other) / det;
  if (v < 0 || u + v > 1) return;
  const float distance = glm::dot(ac, other) / det;
  if (distance < 0 || distance >= limit) return;
  limit = distance;
  nearest = RayHit{distance, det > 0, triangle};
}

std::optional<RayHit> RayCaster::cast(glm::vec3 from, glm::vec3 direction, float max_distance) const {
  std::optional<RayHit> nearest;
  if (order_.empty()) return nearest;
  float limit = max_distance;
  // A component of exactly 0 would make 0 * infinity on a box's side.
  const glm::vec3 safe = direction + glm::vec3(glm::equal(direction, glm::vec3(0))) * 1e-12f;
  const glm::vec3 inverse = 1.0f / safe;
  struct Entry {
    size_t node;
    float distance;
  };
  std::array<Entry, 64> stack;  // a tree over 2^32 triangles is 30 deep, and each level leaves one entry behind
  size_t depth = 0;
  stack[depth++] = {0, 0};
  while (depth > 0) {
    const Entry top = stack[--depth];
    if (top.distance > limit) continue;
    if (top.node >= leaves_ - 1) {
      const size_t first = (top.node - (leaves_ - 1)) * kLeafTriangles;
      const size_t last = std::min(first + kLeafTriangles, order_.size());
      for (size_t i = first; i < last; ++i) meet(order_[i], from, direction, nearest, limit);
      continue;
    }
    const size_t left = 2 * top.node + 1, right = left + 1;
    const float near_left = entry(nodes_[left].lo, nodes_[left].hi, from, inverse, limit);
    const float near_right = entry(nodes_[right].lo, nodes_[right].hi, from, inverse, limit);
    const bool left_first = near_left <= near_right;
    // The nearer child is pushed last and so looked into first.
    const Entry later = left_first ? Entry{right, near_right} : Entry{left, near_left};
    const Entry sooner = left_first ? Entry{left, near_left} : Entry{right, near_right};
    if (later.distance >= 0) stack[depth++] = later;
    if (sooner.distance >= 0) stack[depth++] = sooner;
  }
  return nearest;
}

}  // namespace sgm

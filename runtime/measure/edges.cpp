#include "measure/edges.h"

#include <algorithm>

namespace sgm::measure {

Edges::Edges(const Triangles& mesh) : halves_(mesh.memory), start_(mesh.memory) {
  const std::span<const Triangle> triangles = mesh.triangles;
  const size_t vertex_count = mesh.points.size();
  struct Entry {
    uint32_t high;
    HalfEdge half;
    bool operator<(const Entry& other) const { return high != other.high ? high < other.high : half < other.half; }
  };
  LargeVector<uint32_t> first(vertex_count + 1, mesh.memory);
  const auto each = [&](auto&& visit) {
    for (size_t i = 0; i < triangles.size(); ++i) {
      const Triangle& t = triangles[i];
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      for (uint32_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
        visit(low, high, static_cast<HalfEdge>(3 * i + k));
      }
    }
  };
  each([&](uint32_t low, uint32_t, HalfEdge) { ++first[low + 1]; });
  for (size_t v = 0; v < vertex_count; ++v) first[v + 1] += first[v];
  LargeVector<Entry> entries(first.back(), mesh.memory);
  LargeVector<uint32_t> next(first.begin(), first.end() - 1, mesh.memory);
  each([&](uint32_t low, uint32_t high, HalfEdge half) { entries[next[low]++] = {high, half}; });

  halves_.resize(entries.size());
  start_.reserve(entries.size() / 2 + 1);
  for (size_t v = 0; v < vertex_count; ++v) {
    std::sort(entries.begin() + first[v], entries.begin() + first[v + 1]);
    for (uint32_t i = first[v]; i < first[v + 1]; ++i) {
      if (i == first[v] || entries[i].high != entries[i - 1].high) start_.push_back(i);
      halves_[i] = entries[i].half;
    }
  }
  start_.push_back(static_cast<uint32_t>(entries.size()));
}

}  // namespace sgm::measure

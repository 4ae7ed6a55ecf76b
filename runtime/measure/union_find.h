#pragma once
// Union-find: groups of connected elements.

#include <cstdint>
#include <numeric>
#include <utility>

#include "base/large_pages.h"

namespace sgm::measure {

/// Groups of connected elements. The root of a group is its lowest member.
class UnionFind {
 public:
  UnionFind(size_t count, std::pmr::memory_resource* memory) : parent_(count, memory) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  uint32_t rootOf(uint32_t v) {
    while (parent_[v] != v) {
      parent_[v] = parent_[parent_[v]];
      v = parent_[v];
    }
    return v;
  }
  void join(uint32_t a, uint32_t b) {
    a = rootOf(a);
    b = rootOf(b);
    if (a < b) std::swap(a, b);
    parent_[a] = b;
  }
  size_t size() const { return parent_.size(); }

 private:
  LargeVector<uint32_t> parent_;
};

}  // namespace sgm::measure

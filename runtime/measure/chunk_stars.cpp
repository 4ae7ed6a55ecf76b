#include "measure/chunk_stars.h"

#include <algorithm>
#include <bit>
#include <vector>

namespace sgm::measure {
namespace {

class StarCounter {
 public:
  StarCounter(std::span<const uint32_t> indices, std::span<const uint8_t> planes, StarScratch& scratch)
      : planes_(planes),
        first_(scratch.first),
        corners_(scratch.corners),
        seen_(scratch.seen),
        nodes_(scratch.first.get_allocator()),
        opposite_(scratch.first.get_allocator()) {
    first_.assign(planes.size() + 1, 0);
    seen_.assign(planes.size(), kNobody);
    if (corners_.size() < indices.size()) corners_.resize(indices.size());
    sortCorners(indices);
  }

  StarCounts run() {
    size_t ends = 0;
    for (uint32_t v = 0; v < planes_.size(); ++v) {
      const std::span star(corners_.data() + first_[v], corners_.data() + first_[v + 1]);
      if (star.empty()) continue;
      ++counts_.vertices;
      const bool simple = meet(v, star);
      if (simple && isCycle(v, star)) {
        ends += star.size();
      } else if (simple && isPath(v, star)) {
        ends += star.size() + 1;
      } else {
        ends += countStar(v, star);
      }
    }
    // Each edge was counted once at each of its two ends.
    counts_.edges = static_cast<uint32_t>(ends / 2);
    return counts_;
  }

 private:
  static constexpr uint64_t kNobody = UINT64_MAX;
  /// Packs an entry of StarScratch::seen: the vertex for which it is made in the high half, an index in the low half.
  static uint64_t seenBy(uint32_t v, uint32_t place) { return uint64_t{v} << 32 | place; }
  /// An edge at the current vertex v, from v to `vertex`. It is a node in the graph of v's link; the root of `parent`
  /// names the node's connected component.
  struct Node {
    uint32_t vertex, parent, out, in;
  };

  /// Groups the corners of all triangles by vertex; each group keeps the order of the triangles.
  void sortCorners(std::span<const uint32_t> indices) {
    for (const uint32_t v : indices) ++first_[v];
    uint32_t sum = 0;
    for (uint32_t& first : first_) first = sum += first;
    // Fills each group from its end, so that first[v] finally is the start of the group.
    for (size_t at = indices.size(); at != 0; at -= 3) {
      const uint32_t a = indices[at - 3], b = indices[at - 2], c = indices[at - 1];
      corners_[--first_[a]] = Corner::of(b, c);
      corners_[--first_[b]] = Corner::of(c, a);
      corners_[--first_[c]] = Corner::of(a, b);
    }
  }

  /// Records each corner of a star (the triangles around v) in seen_, under the corner's next vertex. Returns true if
  /// no vertex is the next vertex of two corners.
  bool meet(uint32_t v, std::span<const Corner> star) {
    bool once = true;
    for (uint32_t i = 0; i < star.size(); ++i) {
      uint64_t& seen = seen_[star[i].next()];
      once &= seen >> 32 != v;
      seen = seenBy(v, i);
    }
    return once;
  }

  /// True if the star (the triangles around v) has the usual form: one closed fan, in which each edge at v has two
  /// triangles that use it in opposite directions. Precondition: meet() returned true.
  bool isCycle(uint32_t v, std::span<const Corner> star) {
    if (star.size() < 3) return false;
    uint32_t at = 0;
    for (size_t steps = star.size(); steps != 0; --steps) {
      const uint64_t seen = seen_[star[at].previous()];
      if (seen >> 32 != v) return false;
      at = static_cast<uint32_t>(seen);
      if (at == 0) return steps == 1;
    }
    return false;
  }

  /// True if the star (the triangles around v) is one open fan. In this case, also counts the two edges at the ends of
  /// the fan. Precondition: meet() returned true.
  bool isPath(uint32_t v, std::span<const Corner> star) {
    // Walk over the fan from triangle to triangle: corner a is followed by the corner b whose next vertex is a's
    // previous vertex. The first corner of the fan follows no other one. So its index is the sum of all indices minus
    // the sum of the indices of the corners that follow another one.
    size_t start = star.size() * (star.size() - 1) / 2, matched = 0;
    for (const Corner& corner : star) {
      const uint64_t seen = seen_[corner.previous()];
      if (seen >> 32 != v) continue;
      start -= static_cast<uint32_t>(seen);
      ++matched;
    }
    if (matched + 1 != star.size() || start >= star.size()) return false;
    size_t at = start;
    for (size_t steps = 1; steps < star.size(); ++steps) {
      const uint64_t seen = seen_[star[at].previous()];
      if (seen >> 32 != v) return false;
      at = static_cast<uint32_t>(seen);
    }
    // If a corner follows the last one, the walk has run into a cycle. Otherwise it has visited each corner once.
    if (seen_[star[at].previous()] >> 32 == v) return false;
    for (const uint32_t end : {star[start].next(), star[at].previous()}) {
      if (end > v) countOpen(v, end);
    }
    return true;
  }

  uint32_t rootOf(uint32_t node) {
    while (nodes_[node].parent != node) node = nodes_[node].parent = nodes_[nodes_[node].parent].parent;
    return node;
  }

  uint32_t nodeOf(uint32_t v, uint32_t other) {
    uint64_t& seen = seen_[other];
    const uint32_t mark = v | uint32_t{1} << 31;  // the high bit tells these marks apart from those of meet()
    if (seen >> 32 != mark) {
      const auto place = static_cast<uint32_t>(nodes_.size());
      seen = seenBy(mark, place);
      nodes_.push_back({other, place, 0, 0});
    }
    return static_cast<uint32_t>(seen);
  }

  /// Counts the defects at vertex v, for any star (the triangles around v). Returns the number of edges at v.
  size_t countStar(uint32_t v, std::span<const Corner> star) {
    nodes_.clear();
    opposite_.clear();
    size_t joined = 0;
    for (const Corner& corner : star) {
      const uint32_t a = nodeOf(v, corner.next()), b = nodeOf(v, corner.previous());
      ++nodes_[a].out;
      ++nodes_[b].in;
      const uint32_t root_a = rootOf(a), root_b = rootOf(b);
      nodes_[root_a].parent = root_b;
      joined += root_a != root_b;
      if (corner.next() > v && corner.previous() > v) {
        opposite_.push_back(uint64_t{std::min(corner.next(), corner.previous())} << 32 |
                            std::max(corner.next(), corner.previous()));
      }
    }
    counts_.pinched_vertices += nodes_.size() - joined > 1;
    for (const Node& node : nodes_) {
      if (node.vertex > v) countEdge(v, node);
    }
    std::sort(opposite_.begin(), opposite_.end());
    for (size_t i = 1; i < opposite_.size(); ++i) counts_.duplicate_triangles += opposite_[i] == opposite_[i - 1];
    return nodes_.size();
  }

  void countOpen(uint32_t v, uint32_t other) {
    const uint32_t shared = planes_[v] & planes_[other] & 63u;
    if (shared != 0) {
      ++counts_.border_edges[static_cast<size_t>(std::countr_zero(shared))];
    } else {
      ++counts_.open_edges;
    }
  }

  void countEdge(uint32_t v, const Node& node) {
    const uint32_t triangles = node.out + node.in;
    if (triangles == 1) {
      countOpen(v, node.vertex);
    } else if (triangles == 2) {
      counts_.turned_edges += node.out != 1;
    } else {
      ++counts_.nonmanifold_edges;
    }
  }

  std::span<const uint8_t> planes_;
  std::pmr::vector<uint32_t>& first_;
  std::pmr::vector<Corner>& corners_;
  std::pmr::vector<uint64_t>& seen_;
  std::pmr::vector<Node> nodes_;
  std::pmr::vector<uint64_t> opposite_;
  StarCounts counts_;
};

}  // namespace

StarCounts countStars(std::span<const uint32_t> indices, std::span<const uint8_t> planes, StarScratch& scratch) {
  return indices.empty() ? StarCounts{} : StarCounter(indices, planes, scratch).run();
}

}  // namespace sgm::measure

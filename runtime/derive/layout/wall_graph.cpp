#include "derive/layout/wall_graph.h"

#include <algorithm>

namespace sgm {

WallGraph wallGraph(const PlanRect& whole, std::span<const PlanRect> cells) {
  WallGraph graph;
  const auto order = [](const WallGraph::Corner& a, const WallGraph::Corner& b) {
    return a.x != b.x ? a.x < b.x : a.z < b.z;
  };
  for (const PlanRect& c : cells)
    graph.corners.insert(graph.corners.end(), {{c.x0, c.z0}, {c.x1, c.z0}, {c.x0, c.z1}, {c.x1, c.z1}});
  std::sort(graph.corners.begin(), graph.corners.end(), order);
  graph.corners.erase(std::unique(graph.corners.begin(), graph.corners.end()), graph.corners.end());
  // Only the high sides of each cell are added: a low side is the high side of a neighbouring cell, or an outer wall.
  for (const PlanRect& c : cells) {
    for (const bool along_x : {false, true}) {
      if (along_x ? c.z1 == whole.z1 : c.x1 == whole.x1) continue;
      size_t before = SIZE_MAX;
      int32_t at = 0;
      std::vector<size_t> on;
      for (size_t i = 0; i < graph.corners.size(); ++i) {
        const WallGraph::Corner& p = graph.corners[i];
        if (along_x ? p.z == c.z1 && p.x >= c.x0 && p.x <= c.x1 : p.x == c.x1 && p.z >= c.z0 && p.z <= c.z1)
          on.push_back(i);
      }
      for (const size_t i : on) {
        const int32_t here = along_x ? graph.corners[i].x : graph.corners[i].z;
        if (before != SIZE_MAX) graph.edges.push_back({before, i, along_x, here - at});
        before = i;
        at = here;
      }
    }
  }
  return graph;
}

WallPaths::WallPaths(const WallGraph& graph, const std::vector<bool>& walked)
    : corners_(graph.corners.size()),
      length_(corners_ * corners_, kNone),
      next_(corners_ * corners_, kNoEdge),
      graph_(graph) {
  for (size_t i = 0; i < corners_; ++i) length_[i * corners_ + i] = 0;
  for (size_t e = 0; e < graph.edges.size(); ++e) {
    const WallGraph::Edge& edge = graph.edges[e];
    for (const auto& [a, b] : {std::pair{edge.from, edge.to}, std::pair{edge.to, edge.from}}) {
      length_[a * corners_ + b] = walked[e] ? 0 : edge.length;
      next_[a * corners_ + b] = e;
    }
  }
  for (size_t k = 0; k < corners_; ++k)
    for (size_t i = 0; i < corners_; ++i)
      for (size_t j = 0; j < corners_; ++j) {
        const int64_t through = length_[i * corners_ + k] + length_[k * corners_ + j];
        if (through >= length_[i * corners_ + j]) continue;
        length_[i * corners_ + j] = through;
        next_[i * corners_ + j] = next_[i * corners_ + k];
      }
}

bool WallPaths::walk(size_t from, size_t to, std::vector<bool>& edges) const {
  for (size_t steps = 0; from != to; ++steps) {
    const size_t e = next_[from * corners_ + to];
    if (e == kNoEdge || steps > graph_.edges.size()) return false;
    edges[e] = true;
    from = graph_.edges[e].from == from ? graph_.edges[e].to : graph_.edges[e].from;
  }
  return true;
}

}  // namespace sgm

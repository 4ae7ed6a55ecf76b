#include "tools/survey/contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace sgm::survey {
namespace {

/// Number of a grid edge: twice the index of its first point, plus 1 if the edge runs along y.
using Edge = size_t;

struct Segment {
  Edge from = 0, to = 0;
};

class Marcher {
 public:
  Marcher(const Grid& grid, float level) : grid_(grid), level_(level) {}

  std::vector<Line> lines() {
    for (int y = 0; y + 1 < grid_.height; ++y)
      for (int x = 0; x + 1 < grid_.width; ++x) cell(x, y);
    return joined();
  }

 private:
  Edge along(int x, int y) const { return 2 * grid_.index(x, y); }
  Edge down(int x, int y) const { return 2 * grid_.index(x, y) + 1; }

  void cell(int x, int y) {
    const std::array corners{grid_.at(x, y), grid_.at(x + 1, y), grid_.at(x + 1, y + 1), grid_.at(x, y + 1)};
    unsigned state = 0;
    float sum = 0;
    for (unsigned i = 0; i < corners.size(); ++i) {
      if (std::isnan(corners[i])) return;
      state |= (corners[i] > level_ ? 1u : 0u) << i;
      sum += corners[i];
    }
    const Edge top = along(x, y), right = down(x + 1, y), bottom = along(x, y + 1), left = down(x, y);
    const std::array edges{top, right, bottom, left};
    // Edge i lies between corners i and i + 1. Going around the cell, values rise above the level at some edges, and
    // fall below it at others. A contour segment joins a rising and a falling edge. If there are two of each, the mean
    // of the corners decides which pairs are joined.
    std::array<Edge, 2> rising{}, falling{};
    size_t rises = 0, falls = 0;
    std::array<size_t, 2> rise_at{}, fall_at{};
    for (size_t i = 0; i < 4; ++i) {
      const bool here = (state >> i & 1) != 0, next = (state >> ((i + 1) % 4) & 1) != 0;
      if (!here && next) rise_at[rises] = i, rising[rises++] = edges[i];
      if (here && !next) fall_at[falls] = i, falling[falls++] = edges[i];
    }
    if (rises == 0) return;
    if (rises == 1) return add(falling[0], rising[0]);
    const bool together = sum / 4 > level_;
    for (size_t i = 0; i < 2; ++i) {
      // A corner above the level lies between a rising edge and the next falling edge.
      const size_t after = (rise_at[i] + 1) % 4;
      const size_t same = fall_at[0] == after ? 0 : 1;
      add(falling[together ? 1 - same : same], rising[i]);
    }
  }

  void add(Edge from, Edge to) {
    next_[from] = segments_.size();
    segments_.push_back({from, to});
  }

  Point placeOn(Edge edge) const {
    const size_t at = edge / 2, other = edge % 2 == 0 ? at + 1 : at + static_cast<size_t>(grid_.width);
    const double a = grid_.values[at], b = grid_.values[other], share = (static_cast<double>(level_) - a) / (b - a);
    const auto width = static_cast<size_t>(grid_.width);
    const double x = static_cast<double>(at % width), y = static_cast<double>(at / width);
    return edge % 2 == 0 ? Point{x + share, y} : Point{x, y + share};
  }

  /// Joins segments with equal ends into lines. Each edge is the start of at most one segment, and the end of at most
  /// one.
  std::vector<Line> joined() const {
    std::unordered_map<Edge, size_t> came;
    for (size_t i = 0; i < segments_.size(); ++i) came[segments_[i].to] = i;
    std::vector<bool> used(segments_.size());
    std::vector<Line> lines;
    const auto follow = [&](size_t first) {
      Line line{placeOn(segments_[first].from)};
      for (size_t at = first;;) {
        used[at] = true;
        line.push_back(placeOn(segments_[at].to));
        const auto next = next_.find(segments_[at].to);
        if (next == next_.end() || used[next->second]) break;
        at = next->second;
      }
      lines.push_back(std::move(line));
    };
    for (size_t i = 0; i < segments_.size(); ++i)
      if (!came.contains(segments_[i].from)) follow(i);
    for (size_t i = 0; i < segments_.size(); ++i)
      if (!used[i]) follow(i);
    return lines;
  }

  const Grid& grid_;
  float level_;
  std::vector<Segment> segments_;
  std::unordered_map<Edge, size_t> next_;  ///< for each edge, the index of the segment that starts there
};

}  // namespace

float Grid::between(Point p) const {
  const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y));
  const int right = std::min(x + 1, width - 1), below = std::min(y + 1, height - 1);
  if (!holds(x, y)) return kUnknown;
  const auto u = static_cast<float>(p.x - x), v = static_cast<float>(p.y - y);
  return (1 - v) * ((1 - u) * at(x, y) + u * at(right, y)) + v * ((1 - u) * at(x, below) + u * at(right, below));
}

std::vector<Line> contours(const Grid& grid, float level) { return Marcher(grid, level).lines(); }

std::vector<Line> areasAbove(const Grid& grid, float level) {
  // Surround the grid by much lower values, so that every contour becomes a closed ring. Contours that leave the grid
  // are closed just outside its border.
  Grid framed(grid.width + 2, grid.height + 2, level - 1e6f);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) framed.at(x + 1, y + 1) = grid.at(x, y);
  std::vector<Line> rings = contours(framed, level);
  for (Line& ring : rings)
    for (Point& p : ring) p = {p.x - 1, p.y - 1};
  return rings;
}

Line smoothed(const Line& line) {
  if (line.size() < 3) return line;
  const bool ring = line.front() == line.back();
  Line out = line;
  for (int round = 0; round < 2; ++round) {
    Line cut;
    if (!ring) cut.push_back(out.front());
    for (size_t i = 1; i < out.size(); ++i) {
      const Point &a = out[i - 1], &b = out[i];
      cut.push_back({0.75 * a.x + 0.25 * b.x, 0.75 * a.y + 0.25 * b.y});
      cut.push_back({0.25 * a.x + 0.75 * b.x, 0.25 * a.y + 0.75 * b.y});
    }
    cut.push_back(ring ? cut.front() : out.back());
    out = std::move(cut);
  }
  return out;
}

void soften(Grid& grid, int times) {
  for (; times > 0; --times) {
    const Grid before = grid;
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        if (std::isnan(before.at(x, y))) continue;
        float sum = 0, weights = 0;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            if (!before.holds(x + dx, y + dy) || std::isnan(before.at(x + dx, y + dy))) continue;
            const float weight = static_cast<float>((2 - std::abs(dx)) * (2 - std::abs(dy)));
            sum += weight * before.at(x + dx, y + dy);
            weights += weight;
          }
        }
        grid.at(x, y) = sum / weights;
      }
    }
  }
}

void spread(Grid& grid, int times) {
  for (; times > 0; --times) {
    const Grid before = grid;
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        if (!std::isnan(before.at(x, y))) continue;
        float sum = 0, count = 0;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            if (!before.holds(x + dx, y + dy) || std::isnan(before.at(x + dx, y + dy))) continue;
            sum += before.at(x + dx, y + dy);
            ++count;
          }
        }
        if (count > 0) grid.at(x, y) = sum / count;
      }
    }
  }
}

double squaresAbove(const Grid& grid) {
  double squares = 0;
  for (const float value : grid.values) squares += std::clamp(static_cast<double>(value) + 0.5, 0.0, 1.0);
  return squares;
}

double lengthOf(const Line& line) {
  double length = 0;
  for (size_t i = 1; i < line.size(); ++i) length += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
  return length;
}

}  // namespace sgm::survey

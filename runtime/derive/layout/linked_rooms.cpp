#include "derive/layout/linked_rooms.h"

#include <algorithm>

namespace sgm {
namespace {

/// Rows with at most this many parts are tried in all permutations; for longer rows only swaps of two parts are tried.
constexpr size_t kMaxPermuted = 3;

size_t linksMet(std::span<const PlanRect> rooms, std::span<const RoomLink> links, int32_t wall) {
  return static_cast<size_t>(std::count_if(links.begin(), links.end(), [&](const RoomLink& link) {
    const PlanRect &a = rooms[link.a], &b = rooms[link.b];
    const int32_t x = std::min(a.x1, b.x1) - std::max(a.x0, b.x0), z = std::min(a.z1, b.z1) - std::max(a.z0, b.z0);
    return std::min(x, z) == 0 && std::max(x, z) - wall >= link.width;
  }));
}

/// Returns the variants of a treemap's row: other orders of its parts, and the row moved to the other end of the space
/// that previous rows have left. The first row, with the largest rooms, is not moved, since the entrance is in front.
/// first: whether the row is the first one.
std::vector<TreemapRow> choicesOf(const TreemapRow& row, bool first) {
  std::vector<TreemapRow> out{row};
  TreemapRow other = row;
  if (row.parts.size() <= kMaxPermuted) {
    std::sort(other.parts.begin(), other.parts.end());
    do {
      out.push_back(other);
    } while (std::next_permutation(other.parts.begin(), other.parts.end()));
  } else {
    for (size_t i = 0; i < row.parts.size(); ++i)
      for (size_t j = i + 1; j < row.parts.size(); ++j) {
        other = row;
        std::swap(other.parts[i], other.parts[j]);
        out.push_back(other);
      }
  }
  const size_t orders = out.size();
  for (size_t i = 0; i < orders && !first && !row.last; ++i) {
    out.push_back(out[i]);
    out.back().behind = true;
  }
  return out;
}

/// Local search: changes rows until no other variant of one or two rows satisfies more links.
class RoomSearch {
 public:
  RoomSearch(const PlanRect& whole, std::span<const double> areas, std::span<const RoomLink> links, int32_t wall,
             int32_t step, PlanWork& work)
      : whole_(whole), areas_(areas), links_(links), wall_(wall), step_(step), work_(work) {
    rows_ = squarifiedRows(whole, areas, step);
    best_ = placedRows(whole, areas, rows_, step);
    met_ = linksMet(best_, links, wall);
    for (size_t r = 0; r < rows_.size(); ++r) choices_.push_back(choicesOf(rows_[r], r == 0));
  }

  std::vector<PlanRect> run() {
    while (met_ < links_.size() && improve()) continue;
    return best_;
  }

 private:
  bool improve() {
    for (size_t r = 0; r < rows_.size(); ++r)
      for (size_t s = r; s < rows_.size(); ++s) {
        std::vector<TreemapRow> tried = rows_;
        for (const TreemapRow& one : choices_[r]) {
          tried[r] = one;
          for (size_t c = 0; c < (s == r ? 1 : choices_[s].size()); ++c) {
            if (s != r) tried[s] = choices_[s][c];
            if (takes(tried)) return true;
            if (work_.spent()) return false;
          }
        }
      }
    return false;
  }

  bool takes(const std::vector<TreemapRow>& rows) {
    work_.done += areas_.size() + links_.size() / 8;
    std::vector<PlanRect> rooms = placedRows(whole_, areas_, rows, step_);
    const size_t met = linksMet(rooms, links_, wall_);
    if (met <= met_) return false;
    met_ = met;
    best_ = std::move(rooms);
    rows_ = rows;
    return true;
  }

  PlanRect whole_;
  std::span<const double> areas_;
  std::span<const RoomLink> links_;
  int32_t wall_, step_;
  std::vector<std::vector<TreemapRow>> choices_;
  std::vector<TreemapRow> rows_;
  std::vector<PlanRect> best_;
  size_t met_ = 0;
  PlanWork& work_;
};

}  // namespace

std::vector<PlanRect> linkedRooms(const PlanRect& whole, std::span<const double> areas, std::span<const RoomLink> links,
                                  int32_t wall, int32_t step, PlanWork& work) {
  return RoomSearch(whole, areas, links, wall, step, work).run();
}

}  // namespace sgm

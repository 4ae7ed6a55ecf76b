#include "derive/layout/plan_rects.h"

#include <algorithm>

namespace sgm {
namespace {

bool holds(const PlanRect& a, const PlanRect& b) {
  return a.x0 <= b.x0 && a.z0 <= b.z0 && a.x1 >= b.x1 && a.z1 >= b.z1;
}

bool overlap(const PlanRect& a, const PlanRect& b) {
  const PlanRect both = common(a, b);
  return both.x0 < both.x1 && both.z0 < both.z1;
}

}  // namespace

void takeAway(Rects& from, const PlanRect& r) {
  if (std::none_of(from.begin(), from.end(), [&](const PlanRect& f) { return overlap(f, r); })) return;
  Rects left;
  for (const PlanRect& f : from) {
    if (!overlap(f, r)) {
      left.push_back(f);
      continue;
    }
    if (f.x0 < r.x0) left.push_back({f.x0, f.z0, r.x0, f.z1});
    if (r.x1 < f.x1) left.push_back({r.x1, f.z0, f.x1, f.z1});
    if (f.z0 < r.z0) left.push_back({f.x0, f.z0, f.x1, r.z0});
    if (r.z1 < f.z1) left.push_back({f.x0, r.z1, f.x1, f.z1});
  }
  from.clear();
  for (size_t i = 0; i < left.size(); ++i) {
    bool held = false;
    for (size_t j = 0; j < left.size() && !held; ++j)
      held = i != j && holds(left[j], left[i]) && (left[i] != left[j] || j < i);
    if (!held) from.push_back(left[i]);
  }
}

bool keepWalkable(Rects& room, int32_t width) {
  std::erase_if(room, [&](const PlanRect& r) { return !admits(r, width); });
  if (room.empty()) return false;
  size_t kept = 1;
  for (size_t from = 0; from < kept; ++from)
    for (size_t i = kept; i < room.size(); ++i)
      if (admits(common(room[from], room[i]), width)) std::swap(room[i], room[kept++]);
  const bool whole = kept == room.size();
  room.resize(kept);
  return whole;
}

std::optional<PlanRect> holeBetween(const Rects& a, const Rects& b, int32_t wall, int32_t width) {
  std::optional<PlanRect> best;
  int32_t widest = width - 1;
  for (const PlanRect& p : a) {
    for (const PlanRect& q : b) {
      const PlanRect both = common(p, q);
      const bool beside = both.x0 - both.x1 == wall, behind = both.z0 - both.z1 == wall;
      const int32_t span = beside ? both.depth() : both.width();
      if (beside == behind || span <= widest) continue;
      widest = span;
      const int32_t low = (beside ? both.z0 : both.x0) + (span - width) / 2 / kPlanStep * kPlanStep;
      best = beside ? PlanRect{both.x1 - kDoorReachUnits, low, both.x0 + kDoorReachUnits, low + width}
                    : PlanRect{low, both.z1 - kDoorReachUnits, low + width, both.z0 + kDoorReachUnits};
    }
  }
  return best;
}

}  // namespace sgm

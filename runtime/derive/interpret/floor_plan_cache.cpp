#include "derive/interpret/floor_plan_cache.h"

#include <bit>
#include <utility>

namespace sgm::interpret {
namespace {

constexpr size_t kMaxPlansKept = 64;
constexpr uint64_t kLooksOfStep = 2;

}  // namespace

FloorPlan FloorPlanCache::layOut(const FloorPlanSizes& sizes, std::span<const double> areas,
                                 std::span<const RoomLink> links, const Span& span, uint32_t activation,
                                 Budget& budget) {
  const auto word = [](int32_t v) { return static_cast<uint64_t>(static_cast<uint32_t>(v)); };
  std::vector<uint64_t> key{word(sizes.x), word(sizes.z), word(sizes.wall), word(sizes.door), word(sizes.corridor)};
  for (const double area : areas) key.push_back(std::bit_cast<uint64_t>(area));
  for (const RoomLink& link : links) key.insert(key.end(), {~uint64_t{0}, link.a, link.b, word(link.width)});
  if (!budget.step(key.size(), span, activation)) return {};
  if (const auto known = plans_.find(key); known != plans_.end()) return known->second;
  FloorPlan plan = layOutFloor(sizes, areas, links, kLooksOfStep * (budget.stepsLeft() + 1));
  if (budget.step(plan.work / kLooksOfStep, span, activation) && plans_.size() < kMaxPlansKept)
    plans_.emplace(std::move(key), plan);
  return plan;
}

}  // namespace sgm::interpret

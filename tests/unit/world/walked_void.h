#pragma once
// Determines where a walker can go: floods the void of a field with the walker's box, sample by sample.

#include <vector>

#include "field/evaluate.h"
#include "world_support.h"

namespace sgm {

/// Samples a box, with samples `step` units apart. The walker is a box of samples, and fits at a place if none of them
/// is solid.
class WalkedVoid {
 public:
  /// Lets the walker start at the box's lowest corner, which must lie outside of the places under test, and floods the
  /// void from there. size, walker: numbers of samples along each axis.
  WalkedVoid(const WorldField& world, Int3 low, Int3 size, int32_t step, Int3 walker)
      : low_(low), size_(size), step_(step), walker_(walker) {
    closed_ = solidIn(world);
    for (const auto& [stride, count, wide] : {std::tuple{1, size.x, walker.x}, std::tuple{size.x, size.y, walker.y},
                                              std::tuple{size.x * size.y, size.z, walker.z}})
      closed_ = widened(closed_, stride, count, wide);
    flood();
  }

  /// True if a walker that comes from outside can reach a place with its middle; exact to half a sample.
  bool reaches(Int3 p) const { return walked_[firstOf(p)]; }
  /// Whether a walker fits at a place, even if it cannot reach the place.
  bool fits(Int3 p) const { return !closed_[firstOf(p)]; }

 private:
  /// Index of the lowest sample of a walker whose middle is at p.
  size_t firstOf(Int3 p) const {
    const auto first = [&](int32_t at, int32_t low, int32_t wide) {
      return (2 * (at - low) + step_ - (wide - 1) * step_) / (2 * step_);
    };
    return index(first(p.x, low_.x, walker_.x), first(p.y, low_.y, walker_.y), first(p.z, low_.z, walker_.z));
  }
  size_t index(int32_t x, int32_t y, int32_t z) const { return static_cast<size_t>(x + size_.x * (y + size_.y * z)); }

  std::vector<bool> solidIn(const WorldField& world) const {
    const auto program =
        world.compile({low_, {low_.x + size_.x * step_, low_.y + size_.y * step_, low_.z + size_.z * step_}}, 0);
    REQUIRE(program);
    EvalScratch scratch;
    std::vector<int32_t> x, y, z;
    for (int32_t k = 0; k < size_.z; ++k)
      for (int32_t j = 0; j < size_.y; ++j)
        for (int32_t i = 0; i < size_.x; ++i) {
          x.push_back(low_.x + i * step_);
          y.push_back(low_.y + j * step_);
          z.push_back(low_.z + k * step_);
        }
    std::vector<int32_t> q(x.size());
    scalarKernels().samples((*program)->view(), {x.data(), y.data(), z.data(), x.size()}, scratch, q.data());
    std::vector<bool> solid(q.size());
    for (size_t i = 0; i < q.size(); ++i) solid[i] = q[i] < 0;
    return solid;
  }

  /// For each sample: true if the sample itself, or one of the next `wide` - 1 samples along the axis, is closed or
  /// lies outside the box.
  static std::vector<bool> widened(const std::vector<bool>& closed, int32_t stride, int32_t count, int32_t wide) {
    std::vector<bool> out(closed.size());
    for (int32_t i = 0; i < static_cast<int32_t>(closed.size()); ++i) {
      bool any = i / stride % count + wide > count;
      for (int32_t k = 0; k < wide && !any; ++k) any = closed[static_cast<size_t>(i + k * stride)];
      out[static_cast<size_t>(i)] = any;
    }
    return out;
  }

  void flood() {
    walked_.assign(closed_.size(), false);
    std::vector<int32_t> open{0};
    while (!open.empty()) {
      const int32_t i = open.back();
      open.pop_back();
      if (walked_[static_cast<size_t>(i)] || closed_[static_cast<size_t>(i)]) continue;
      walked_[static_cast<size_t>(i)] = true;
      for (const auto& [stride, count] :
           {std::pair{1, size_.x}, std::pair{size_.x, size_.y}, std::pair{size_.x * size_.y, size_.z}}) {
        if (i / stride % count > 0) open.push_back(i - stride);
        if (i / stride % count + 1 < count) open.push_back(i + stride);
      }
    }
  }

  Int3 low_, size_;
  int32_t step_;
  Int3 walker_;
  std::vector<bool> closed_, walked_;  ///< indexed by the walker's lowest sample
};

}  // namespace sgm

#include "tools/render/brightness_tally.h"

#include <algorithm>
#include <cmath>

namespace sgm {

void BrightnessTally::add(float brightness) {
  if (!(brightness >= 0)) return;  // negative values and NaN have no bin
  logarithms_ += std::log(double{brightness} + 1e-4);
  ++count_;
  const float bin = kFinest * (std::log2(std::max(brightness, 1e-6f)) + kLeast);
  ++bins_[static_cast<size_t>(std::clamp(bin, 0.0f, static_cast<float>(bins_.size() - 1)))];
}

void BrightnessTally::add(const BrightnessTally& other) {
  logarithms_ += other.logarithms_;
  count_ += other.count_;
  for (size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
}

float BrightnessTally::mean() const {
  return count_ > 0 ? static_cast<float>(std::exp(logarithms_ / static_cast<double>(count_))) : 0.0f;
}

float BrightnessTally::highlight() const {
  if (count_ == 0) return 0;
  uint64_t brighter = 0;
  size_t bin = bins_.size();
  while (bin > 0 && 20 * brighter < count_) brighter += bins_[--bin];
  return std::exp2((static_cast<float>(bin) + 0.5f) / kFinest - kLeast);
}

}  // namespace sgm

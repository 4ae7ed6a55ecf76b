#pragma once
// Statistics of the brightness of the visible surfaces. The camera's exposure is derived from these statistics.

#include <array>
#include <cstddef>
#include <cstdint>

namespace sgm {

class BrightnessTally {
 public:
  /// Counts one brightness value; ignores NaN and values below 0.
  void add(float brightness);
  void add(const BrightnessTally& other);

  /// Geometric mean of all counted values; 0 if no value was counted.
  float mean() const;
  /// 95th percentile of the counted values, at most 5 % off (half a bin) within the range of the bins; 0 if no value
  /// was counted.
  float highlight() const;

 private:
  /// kFinest: number of histogram bins for each doubling of brightness. The first bin begins at 2^-kLeast.
  static constexpr int kFinest = 8, kLeast = 12;

  double logarithms_ = 0;
  uint64_t count_ = 0;
  std::array<uint64_t, size_t{16} * kFinest> bins_{};
};

}  // namespace sgm

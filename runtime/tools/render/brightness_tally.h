#pragma once
// Statistics of the brightness of visible surfaces, which determine a camera's exposure.

#include <array>
#include <cstddef>
#include <cstdint>

namespace sgm {

class BrightnessTally {
 public:
  /// Counts a brightness; a value below 0 or NaN is ignored.
  void add(float brightness);
  void add(const BrightnessTally& other);

  /// Geometric mean; 0 if nothing was counted.
  float mean() const;
  /// 95th percentile, accurate to a twelfth of its value; 0 if nothing was counted.
  float highlight() const;

 private:
  /// Bins for each doubling of brightness; the first bin begins at 2^-kLeast.
  static constexpr int kFinest = 8, kLeast = 12;

  double logarithms_ = 0;
  uint64_t count_ = 0;
  std::array<uint64_t, size_t{16} * kFinest> bins_{};
};

}  // namespace sgm

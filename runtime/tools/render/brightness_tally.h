#pragma once
// The brightness of visible surfaces, which sets a camera's exposure.

#include <array>
#include <cstddef>
#include <cstdint>

namespace sgm {

class BrightnessTally {
 public:
  /// A brightness below 0, or NaN, is not counted.
  void add(float brightness);
  void add(const BrightnessTally& other);

  /// Logarithmic mean; 0 if nothing was added.
  float mean() const;
  /// 95th percentile, to a twelfth of it; 0 if nothing was added.
  float highlight() const;

 private:
  static constexpr int kFinest = 8, kLeast = 12;  ///< bins for each doubling, from 2^-kLeast on

  double logarithms_ = 0;
  uint64_t count_ = 0;
  std::array<uint64_t, size_t{16} * kFinest> bins_{};
};

}  // namespace sgm

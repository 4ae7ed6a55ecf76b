#pragma once
// How bright the surfaces in sight are, as a camera's exposure depends on it.

#include <array>
#include <cstddef>
#include <cstdint>

namespace sgm {

class BrightnessTally {
 public:
  /// A brightness below 0, or NaN, is not counted.
  void add(float brightness);
  void add(const BrightnessTally& other);

  /// Logarithmic mean; 0 of nothing.
  float mean() const;
  /// So bright or brighter is the brightest twentieth, to a twelfth; 0 of nothing.
  float highlight() const;

 private:
  static constexpr int kFinest = 8, kLeast = 12;  ///< bins for each doubling, from 2^-kLeast on

  double logarithms_ = 0;
  uint64_t count_ = 0;
  std::array<uint64_t, size_t{16} * kFinest> bins_{};
};

}  // namespace sgm

#pragma once
// Determines the shape that makes the surface at a point: the labels of a field may identify shapes instead of
// materials.

#include <cstdint>
#include <optional>
#include <vector>

#include "field/program.h"

namespace sgm {

/// The label of everything not made by a grammar's shape: the domain, a host field, an edit.
inline constexpr uint32_t kNoShape = 0xFFFFFFFFu;

/// Numbers shapes as labels. Not thread-safe.
class ShapeLabels {
 public:
  struct Source {
    uint32_t cell = 0;   ///< index of the compiled cell
    uint32_t shape = 0;  ///< in its GrammarChunk::shapes: a leaf, or the union of a sweep's pieces
  };

  uint32_t add(Source source) {
    const auto number = static_cast<uint32_t>(sources_.size());
    sources_.push_back(source);
    // A half of 0 would mean the label of the solid that is cut.
    return makeLabel(static_cast<uint16_t>(1 + number % kHalf), static_cast<uint16_t>(1 + number / kHalf));
  }
  /// nullopt for kNoShape and unknown labels.
  std::optional<Source> find(uint32_t label) const {
    if (label == kNoShape || (label & 0xFFFF) == 0 || label >> 16 == 0) return std::nullopt;
    const uint64_t number = uint64_t{(label & 0xFFFF) - 1} + uint64_t{kHalf} * ((label >> 16) - 1);
    return number < sources_.size() ? std::optional(sources_[number]) : std::nullopt;
  }

 private:
  static constexpr uint32_t kHalf = 0xFFFE;

  std::vector<Source> sources_;
};

}  // namespace sgm

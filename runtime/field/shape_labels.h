#pragma once
// Which shape makes the surface at a point: a field's labels may name shapes instead of materials.

#include <cstdint>
#include <optional>
#include <vector>

#include "field/program.h"

namespace sgm {

/// What does not come of a grammar's shape: the domain itself, a field of the host's, an edit.
inline constexpr uint32_t kNoShape = 0xFFFFFFFFu;

/// Numbers shapes as labels. Not thread-safe.
class ShapeLabels {
 public:
  struct Source {
    uint32_t cell = 0;   ///< of those that were compiled
    uint32_t shape = 0;  ///< in its GrammarChunk::shapes: a leaf, or the union of a sweep's pieces
  };

  uint32_t add(Source source) {
    const auto number = static_cast<uint32_t>(sources_.size());
    sources_.push_back(source);
    // A half that is 0 would stand for what was cut into.
    return makeLabel(static_cast<uint16_t>(1 + number % kHalf), static_cast<uint16_t>(1 + number / kHalf));
  }
  /// Nothing for kNoShape.
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

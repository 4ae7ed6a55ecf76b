#pragma once
// Determines which shape forms the surface at a point: instead of materials, the labels of a field can identify shapes.

#include <cstdint>
#include <optional>
#include <vector>

#include "field/program.h"

namespace sgm {

/// The label of everything that does not come from a shape of a grammar: the domain, host fields and edits.
inline constexpr uint32_t kNoShape = 0xFFFFFFFFu;

/// Assigns numbers to shapes, for use as labels. Not thread-safe.
class ShapeLabels {
 public:
  struct Source {
    uint32_t cell = 0;   ///< index of the cell among the compiled cells
    uint32_t shape = 0;  ///< index in GrammarChunk::shapes of that cell: a leaf, or the union of the pieces of a sweep
  };

  uint32_t add(Source source) {
    const auto number = static_cast<uint32_t>(sources_.size());
    sources_.push_back(source);
    // Both halves of a label are at least 1, since 0 would stand for the material or tag of the solid that is cut.
    return makeLabel(static_cast<uint16_t>(1 + number % kHalf), static_cast<uint16_t>(1 + number / kHalf));
  }
  /// Returns the shape of a label; nullopt for kNoShape and unknown labels.
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

#pragma once
// The uses of rules in one cell, and their names.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "derive/frame.h"
#include "derive/interpret/cell_inputs.h"
#include "derive/shape.h"

namespace sgm::interpret {

/// A range of the overrides by path that may apply in the cell, in the order of Program::path_overrides.
struct PathRange {
  uint32_t first = 0, end = 0;
};

/// One activation of a rule, or of an override's block.
struct Activation {
  uint32_t rule = 0;
  uint32_t edit = kNone;     ///< index in Program::overrides if a block: below the activation that it replaces
  NameId qualifier = kNoId;  ///< of the rule in its call: `cave` of cave.Hall
  uint32_t parent = kNone;
  uint32_t index = 0;                  ///< among the parent's activations of the same rule, for the readable path
  Placement start;                     ///< the initial scope of the rule
  std::vector<PathRange> leads;        ///< the overrides by path whose first steps lead here
  uint32_t steps = 0;                  ///< the number of these steps
  std::vector<uint32_t> child_counts;  ///< pairs: rule, activations
};

/// All activations of the cell so far, in order of derivation. An activation is denoted by its index; kNone is the
/// layer itself, outside of all rules.
class Activations {
 public:
  explicit Activations(const CellInputs& in) : in_(in) {}

  /// Returns the index of the new activation. References to others become invalid.
  uint32_t add(Activation&& activation);
  /// Counts one more activation of `rule` directly below `parent`, and returns its index among them.
  uint32_t countChild(uint32_t parent, uint32_t rule);

  Activation& operator[](uint32_t i) { return all_[i]; }
  const Activation& operator[](uint32_t i) const { return all_[i]; }
  uint32_t count() const { return static_cast<uint32_t>(all_.size()); }
  size_t bytes() const { return all_.size() * sizeof(Activation); }

  /// The derivation path, "net(0, 0, -1)/Node/Chamber[0]"; empty for kNone.
  std::string pathText(uint32_t activation) const;
  /// The nearest activation that a path can name: activations within the blocks of overrides cannot be overridden.
  uint32_t outsideOfEdits(uint32_t activation) const;

 private:
  const CellInputs& in_;
  std::vector<Activation> all_;
};

}  // namespace sgm::interpret

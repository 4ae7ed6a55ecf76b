#pragma once
// The activations of rules in one cell, and their derivation paths.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "derive/frame.h"
#include "derive/interpret/cell_inputs.h"
#include "derive/shape.h"

namespace sgm::interpret {

/// A range of indices in Program::path_overrides, of overrides that may apply in the cell.
struct PathRange {
  uint32_t first = 0, end = 0;
};

/// One activation of a rule, or of an override's block.
struct Activation {
  uint32_t rule = 0;
  /// for an override's block: the override's index in Program::overrides. The parent is then the activation that the
  /// block replaces.
  uint32_t edit = kNone;
  NameId qualifier = kNoId;  ///< the module alias in the rule's call: `cave` of cave.Hall; kNoId: none
  uint32_t parent = kNone;
  uint32_t index = 0;  ///< index among the parent's activations of the same rule; part of the derivation path
  Placement start;     ///< the initial scope of the rule
  /// ranges of the overrides by path that may apply here or further below: the first `steps` steps of their paths lead
  /// to this activation
  std::vector<PathRange> leads;
  uint32_t steps = 0;  ///< number of steps from the layer's start to this activation
  /// pairs of a rule and the number of its activations directly below this activation
  std::vector<uint32_t> child_counts;
};

/// All activations in the cell so far, in order of derivation, identified by their indices. kNone stands for the layer
/// itself, outside of all rules.
class Activations {
 public:
  explicit Activations(const CellInputs& in) : in_(in) {}

  /// Appends an activation and returns its index. Invalidates references to other activations.
  uint32_t add(Activation&& activation);
  /// Counts a new activation of `rule` directly below `parent`. Returns its index among the activations of that rule.
  uint32_t countChild(uint32_t parent, uint32_t rule);

  Activation& operator[](uint32_t i) { return all_[i]; }
  const Activation& operator[](uint32_t i) const { return all_[i]; }
  uint32_t count() const { return static_cast<uint32_t>(all_.size()); }
  size_t bytes() const { return all_.size() * sizeof(Activation); }

  /// Returns the derivation path, such as "net(0, 0, -1)/Node/Chamber[0]"; empty for kNone.
  std::string pathText(uint32_t activation) const;
  /// Returns the nearest enclosing activation that lies outside of all overrides' blocks. Only such an activation has a
  /// path by which an override can address it.
  uint32_t outsideOfEdits(uint32_t activation) const;

 private:
  const CellInputs& in_;
  std::vector<Activation> all_;
};

}  // namespace sgm::interpret

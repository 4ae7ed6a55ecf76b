#pragma once
// Finds where overrides by path apply, such as `override "net(0, 0, 0)/Node/Chamber[0]" { ... }`.

#include <cstdint>
#include <vector>

#include "derive/interpret/activations.h"
#include "derive/interpret/budget.h"
#include "derive/interpret/cell_inputs.h"

namespace sgm::interpret {

/// The overrides by path that may apply in the cell. Records for each whether its path led to an activation.
class PathOverrides {
 public:
  PathOverrides(const CellInputs& in, Activations& activations);

  bool isEmpty() const { return all_.empty(); }

  /// Follows the paths of the overrides into a new activation of a rule. Returns the overrides whose path ends at this
  /// activation, in the order of Program::overrides.
  std::vector<uint32_t> enter(uint32_t activation);

  /// Adds a note for each override that names this cell but whose path leads to no activation. The note says how far
  /// the path exists in the cell.
  void noteMissed(Budget& budget) const;

 private:
  struct PathOverride {
    uint32_t index = 0;
    bool found = false;
  };

  /// Whether the first `count` steps of the override's path lead to the activation.
  bool isAt(uint32_t activation, const Override& edit, uint32_t count) const;

  const CellInputs& in_;
  Activations& activations_;
  std::vector<PathOverride> all_;
};

}  // namespace sgm::interpret

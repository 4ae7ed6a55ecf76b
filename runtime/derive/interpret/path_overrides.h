#pragma once
// Overrides by path: `override "net(0, 0, 0)/Node/Chamber[0]" { ... }`.

#include <cstdint>
#include <vector>

#include "derive/interpret/activations.h"
#include "derive/interpret/budget.h"
#include "derive/interpret/cell_inputs.h"

namespace sgm::interpret {

/// The overrides by path that may apply in the cell, and for each whether its path has led to an activation.
class PathOverrides {
 public:
  PathOverrides(const CellInputs& in, Activations& activations);

  bool isEmpty() const { return all_.empty(); }

  /// Follows paths into a new activation of a rule. Returns those that end there, as in Program::overrides.
  std::vector<uint32_t> enter(uint32_t activation);

  /// If the path of an override leads nowhere in the only cell that it names, notes how far it does lead.
  void noteMissed(Budget& budget) const;

 private:
  struct PathOverride {
    uint32_t index = 0;
    bool found = false;
  };

  /// True if the activation is where the first `count` steps of the path lead.
  bool isAt(uint32_t activation, const Override& edit, uint32_t count) const;

  const CellInputs& in_;
  Activations& activations_;
  std::vector<PathOverride> all_;
};

}  // namespace sgm::interpret

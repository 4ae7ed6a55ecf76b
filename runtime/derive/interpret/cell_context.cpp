#include "derive/interpret/cell_context.h"

namespace sgm::interpret {

// An override by path names an activation by its index among all activations of its rule, including those that a coarse
// derivation would leave out. Therefore a cell to which such overrides may apply is derived completely.
CellContext::CellContext(const CellInputs& inputs, const CellOptions& options, std::pmr::memory_resource* memory)
    : in(inputs),
      program(in.program),
      activations(in),
      path_overrides(in, activations),
      coarse_edge(path_overrides.isEmpty() ? options.coarse_edge : 0),
      draft(memory),
      budget(in, activations, draft),
      sink(in, draft, budget),
      evaluator(in, activations, draft, budget),
      assets(program),
      rules(*this, options.watch) {}

}  // namespace sgm::interpret

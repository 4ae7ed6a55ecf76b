#pragma once
// Fields from outside the grammar, sampled beside it: a terrain of the engine, or the output of another program.

#include <cstdint>
#include <functional>
#include <span>

#include "field/builder.h"
#include "field/lattice.h"

namespace sgm {

inline constexpr int32_t kWidestHostBlend = 16 * kUnitsPerMetre;

struct HostField {
  /// Writes the field in units, solid below 0, at each point. Must be a pure function of positions and spacing: chunks
  /// that share points request them separately. Called from any thread, also concurrently.
  std::function<Result<void>(const SampleLattice& at, std::span<float> values)> sample;
  uint64_t identity = 0;  ///< of the sampled field: changes if any sample changes
  IntBox bounds;          ///< the field has no effect beyond it by more than two cells and the blend
  bool cut = false;       ///< removes its solid; otherwise adds it
  uint32_t label = 0;     ///< tag << 16 | material
  int32_t smooth = 0;     ///< width of the blend with the existing field, 0 to kWidestHostBlend units; 0: none
  /// The maximum change of the value per unit of distance; 0: unknown. If it is known, a box far from the surface takes
  /// one sample, and a value counts as far if it exceeds kWidestHostBlend and the possible change over two cells.
  float steepness = 0;
};

/// Emits the field over a box as the only group of a layer, with `label` instead of its own label, sampled at the
/// level's cells. Errors: of the samples; invalid_argument if a sample is not finite, or two differ more than the
/// steepness allows; limit if there are more samples than an op can have.
Result<void> emitHostField(ProgramBuilder& builder, const HostField& field, const IntBox& box, int32_t cell,
                           uint32_t layer, uint32_t label, std::pmr::memory_resource* memory);

}  // namespace sgm

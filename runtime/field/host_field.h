#pragma once
// Fields from outside of the grammar, sampled beside it: a terrain that the engine has, or what another program made.

#include <cstdint>
#include <functional>
#include <span>

#include "field/builder.h"
#include "field/lattice.h"

namespace sgm {

inline constexpr int32_t kWidestHostBlend = 16 * kUnitsPerMetre;

struct HostField {
  /// Writes the field in units, solid below 0, at each point. A pure function of positions and spacing: chunks that
  /// share points ask for them one by one. On any thread, several at once.
  std::function<Result<void>(const SampleLattice& at, std::span<float> values)> sample;
  uint64_t identity = 0;  ///< of what it samples: another one wherever any sample differs
  IntBox bounds;          ///< it says nothing farther outside than two cells and the blend
  bool cut = false;       ///< takes its solid away; else adds it
  uint32_t label = 0;     ///< tag << 16 | material
  int32_t smooth = 0;     ///< width of the blend with what is there, 0 to kWidestHostBlend units; 0: none
  /// The most that the value changes over a unit of way; 0: it is not known. Where it is, a box far from the surface
  /// takes one sample, and a value counts as far that is beyond kWidestHostBlend, and beyond what it can change by over
  /// two cells.
  float steepness = 0;
};

/// Emits the field over a box as the only group of a layer, with `label` in the place of its own, sampled as the
/// level's cells are. Errors: of the samples; invalid_argument: a sample is not finite, or two are farther apart than
/// the steepness allows; limit: more samples than an op can have.
Result<void> emitHostField(ProgramBuilder& builder, const HostField& field, const IntBox& box, int32_t cell,
                           uint32_t layer, uint32_t label, std::pmr::memory_resource* memory);

}  // namespace sgm

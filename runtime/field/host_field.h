#pragma once
// Fields whose samples the host program supplies, such as the terrain of an engine; they are not derived from a
// grammar.

#include <cstdint>
#include <functional>
#include <span>

#include "field/builder.h"
#include "field/lattice.h"

namespace sgm {

inline constexpr int32_t kWidestHostBlend = 16 * kUnitsPerMetre;

struct HostField {
  /// Writes the field's value in units at each point; solid is below 0. Must be a pure function of positions and
  /// spacing, because chunks that share points request them separately. Called from any thread, also concurrently.
  std::function<Result<void>(const SampleLattice& at, std::span<float> values)> sample;
  uint64_t identity = 0;  ///< identifies the sampled field: must change if any sample changes
  IntBox bounds;          ///< the field has no effect farther from this box than `smooth` plus two cells
  bool cut = false;       ///< true: removes the field's solid; false: adds it
  uint32_t label = 0;     ///< tag << 16 | material
  int32_t smooth = 0;     ///< width of the blend with the existing field, 0 to kWidestHostBlend units; 0: none
  /// Maximum change of the value per unit of distance; 0: unknown. If it is known, a single sample can prove that a box
  /// is far from the surface; then no other samples are taken in this box. A value counts as far if it exceeds
  /// kWidestHostBlend and the largest possible change over two cells.
  float steepness = 0;
};

/// Samples the field over a box, at the cells of the level, and emits it as the only group of a layer. label: replaces
/// the field's own label. Errors: those of HostField::sample; invalid_argument if a sample is not finite, or if two
/// samples differ by more than the steepness allows; limit if an op cannot have so many samples.
Result<void> emitHostField(ProgramBuilder& builder, const HostField& field, const IntBox& box, int32_t cell,
                           uint32_t layer, uint32_t label, std::pmr::memory_resource* memory);

}  // namespace sgm

#pragma once
// The constant inputs of the derivation of one cell.

#include <cstdint>

#include "base/fixed.h"
#include "derive/frame.h"
#include "derive/interpret/derive.h"
#include "derive/interpret/lower_layers.h"
#include "derive/lattice.h"
#include "derive/parameters.h"
#include "grammar/syntax/program.h"

namespace sgm::interpret {

/// The arguments of deriveCell(), and the constants that follow from them. The arguments must outlive it.
struct CellInputs {
  CellInputs(const Program& of, const ParameterValues& values, uint64_t world_seed, uint32_t layer_number, Int3 at,
             const LowerLayers& below, const DeriveLimits& most);

  /// The origin of the layer's own activation in metres from `base`: a whole domain is one cell, which is centred on
  /// the origin of its scope instead of beginning there.
  Vec3 origin() const;

  const Program& program;
  const ParameterValues& parameters;
  const LowerLayers& lower;
  const DeriveLimits& limits;
  const Layer& layer;
  const uint32_t layer_index;
  const Int3 cell;
  const uint64_t seed;  ///< of the world and the grammar
  Lattice lattice;
  Int3 base;  ///< low corner of the cell, units
};

}  // namespace sgm::interpret

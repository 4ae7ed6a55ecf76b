#pragma once
// The inputs of the derivation of one cell.

#include <cstdint>

#include "base/fixed.h"
#include "derive/frame.h"
#include "derive/interpret/derive.h"
#include "derive/interpret/lower_layers.h"
#include "derive/lattice.h"
#include "derive/parameters.h"
#include "grammar/syntax/program.h"

namespace sgm::interpret {

/// The arguments of deriveCell(), and constants computed from them. The arguments must outlive this object.
struct CellInputs {
  CellInputs(const Program& of, const ParameterValues& values, uint64_t world_seed, uint32_t layer_number, Int3 at,
             const LowerLayers& below, const DeriveLimits& most);

  /// Returns the origin of the start rule's scope in metres from `base`. It is 0, except in a grammar without layers,
  /// whose only cell is centred on the origin of its scope.
  Vec3 origin() const;

  const Program& program;
  const ParameterValues& parameters;
  const LowerLayers& lower;
  const DeriveLimits& limits;
  const Layer& layer;
  const uint32_t layer_index;
  const Int3 cell;
  const uint64_t seed;  ///< hash of the seeds of the world and the grammar
  Lattice lattice;
  Int3 base;  ///< low corner of the cell, in units
};

}  // namespace sgm::interpret

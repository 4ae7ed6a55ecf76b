#include "derive/interpret/cell_inputs.h"

#include "base/hash.h"

namespace sgm::interpret {

CellInputs::CellInputs(const Program& of, const ParameterValues& values, uint64_t world_seed, uint32_t layer_number,
                       Int3 at, const LowerLayers& below, const DeriveLimits& most)
    : program(of),
      parameters(values),
      lower(below),
      limits(most),
      layer(of.layers[layer_number]),
      layer_index(layer_number),
      cell(at),
      seed(hashCombine(of.seed, world_seed)) {
  lattice.seed = hashCombine(seed, hashText(program.text(layer.name)));
  lattice.size = layer.cell;
  for (int a = 0; a < 3; ++a) base[a] = !isWhole(layer) && lattice.hasAxis(a) ? cellBox(layer, cell).lo[a] : 0;
}

Vec3 CellInputs::origin() const {
  if (!isWhole(layer)) return {};
  const Int3 low = program.domain.box.lo;
  return {metres(low.x), metres(low.y), metres(low.z)};
}

}  // namespace sgm::interpret

#include "region/places.h"

#include <limits>
#include <string>

#include "chunk/mesh_chunks.h"
#include "derive/interpret/derive.h"

namespace sgm {
namespace {

constexpr int32_t kCoarsestCell = 1024 * kUnitsPerMetre;

/// Returns the layer with the largest cells by volume; null if no layer is divided into cells.
const Layer* coarsestLayer(const Program& program) {
  const Layer* coarsest = nullptr;
  double most = 0;
  for (const Layer& layer : program.layers) {
    if (isWhole(layer)) continue;
    double volume = 1;
    for (int axis = 0; axis < 3; ++axis) {
      if (layer.cell[axis] > 0) volume *= static_cast<double>(layer.cell[axis]);
    }
    if (volume > most) {
      coarsest = &layer;
      most = volume;
    }
  }
  return coarsest;
}

/// Extends the box, along one axis, to the bounds that are proven for the shapes of all layers. Error: limit if they
/// are unbounded there.
Result<void> addBounds(const Program& program, int axis, IntBox& box) {
  IntBox all;
  for (const Layer& layer : program.layers) all = all.joined(layer.bound);
  if (all.empty()) all = {};
  const bool bounded =
      all.lo[axis] > std::numeric_limits<int32_t>::min() && all.hi[axis] < std::numeric_limits<int32_t>::max();
  if (!bounded) {
    return Error{Code::limit, std::string("a block is unbounded along ") + "xyz"[axis] +
                                  ": the shapes have no proven bound; pass a region instead"};
  }
  box.lo[axis] = all.lo[axis];
  box.hi[axis] = std::max(all.hi[axis], all.lo[axis]) + 1;
  return {};
}

}  // namespace

Result<IntBox> blockRegion(const Program& program, int32_t cells) {
  const Layer* layer = coarsestLayer(program);
  IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    if (layer == nullptr || layer->cell[axis] <= 0) {
      if (Result<void> ok = addBounds(program, axis, box); !ok) return ok.error();
      continue;
    }
    const int64_t hi = int64_t{cells} * layer->cell[axis];
    if (hi > std::numeric_limits<int32_t>::max()) {
      return Error{Code::limit, "a block of " + std::to_string(cells) +
                                    " cells leaves the world, which ends about 2,097 km from the origin"};
    }
    box.lo[axis] = 0;
    box.hi[axis] = static_cast<int32_t>(hi);
  }
  return box;
}

Result<IntBox> regionOf(const Program& program, const Expectation& expectation, const std::optional<IntBox>& given) {
  if (expectation.block > 0) return blockRegion(program, expectation.block);
  if (given) return *given;
  if (!program.domain.infinite) return program.domain.box;
  return blockRegion(program, 1);
}

Result<int32_t> cellFor(std::span<const IntBox> boxes, uint64_t max_chunks) {
  for (int64_t cell = kMeasuredCell; cell <= kCoarsestCell; cell *= 2) {
    uint64_t chunks = 0;
    for (const IntBox& box : boxes) {
      chunks += countChunks(box, cell);
      if (chunks > max_chunks) break;
    }
    if (chunks <= max_chunks) return static_cast<int32_t>(cell);
  }
  return Error{Code::limit, "this takes more than " + std::to_string(max_chunks) +
                                " chunks even with cells of 1,024 m; measure a smaller region, or allow more chunks"};
}

}  // namespace sgm

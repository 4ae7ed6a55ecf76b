#pragma once
// Finds the region of a world to which a statement refers, and the cell edge with which the region is sampled.

#include <optional>
#include <span>

#include "base/result.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// the finest cell edge that is chosen by default, in units
inline constexpr int32_t kMeasuredCell = kUnitsPerMetre / 2;
/// the maximum number of chunks that are meshed by default
inline constexpr uint64_t kMeasuredChunks = 65536;

/// Returns the region of `in block(n)`, lo <= p < hi. It is measured in cells of the layer whose cells have the largest
/// volume (the first, if there are several). On each axis along which this layer is divided into cells, the region
/// covers the cells 0 to n - 1. On the other axes it covers the proven bounds of all layers. Errors: limit if the block
/// leaves the world, or if no bound is proven.
Result<IntBox> blockRegion(const Program& program, int32_t cells);

/// Returns the region of a statement: its `in block(n)`, or else the region `given`, or else the box of a finite world,
/// or else block(1).
Result<IntBox> regionOf(const Program& program, const Expectation& expectation, const std::optional<IntBox>& given);

/// Returns the cell edge in units: kMeasuredCell, doubled until all boxes (lo <= p < hi, not empty) together have at
/// most max_chunks chunks. Error: limit if the cells would have to be larger than 1,024 m.
Result<int32_t> cellFor(std::span<const IntBox> boxes, uint64_t max_chunks);

}  // namespace sgm

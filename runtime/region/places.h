#pragma once
// Finds the region of a world that a statement is about, and the cell edge with which it is sampled.

#include <optional>
#include <span>

#include "base/result.h"
#include "grammar/syntax/program.h"

namespace sgm {

inline constexpr int32_t kMeasuredCell = kUnitsPerMetre / 2;  ///< in units; the finest cell that is chosen by default
/// the maximum number of chunks that are meshed by default
inline constexpr uint64_t kMeasuredChunks = 65536;

/// Returns the region of `in block(n)`, lo <= p < hi. On each axis that layers divide into cells: n cells, starting at
/// cell 0, of the layer whose cells have the largest volume (of several, the first). On other axes: the proven reach of
/// all layers. Errors: limit if the block leaves the world, or if no bound is proven.
Result<IntBox> blockRegion(const Program& program, int32_t cells);

/// Returns the region of a statement: its `in block(n)`, or else `given`, or else all of a finite world, or else
/// block(1).
Result<IntBox> regionOf(const Program& program, const Expectation& expectation, const std::optional<IntBox>& given);

/// Returns kMeasuredCell, doubled until all boxes (lo <= p < hi, not empty) together have at most max_chunks chunks.
/// Error: limit if the cells would have to be larger than 1,024 m.
Result<int32_t> cellFor(std::span<const IntBox> boxes, uint64_t max_chunks);

}  // namespace sgm

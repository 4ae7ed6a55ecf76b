#pragma once
// Finds the part of a world that a statement is about, and the cell to sample it with.

#include <optional>
#include <span>

#include "base/result.h"
#include "grammar/syntax/program.h"

namespace sgm {

inline constexpr int32_t kMeasuredCell = kUnitsPerMetre / 2;  ///< units; the finest cell chosen by default
inline constexpr uint64_t kMeasuredChunks = 65536;            ///< the most chunks meshed by default

/// `in block(n)`, as lo <= p < hi. On each axis that is cut into cells: n cells, from cell 0 on, of the layer with the
/// largest cells by volume (of equal ones the first); on other axes the proven reach of the layers. Errors: limit if
/// the block leaves the world, or if no bound is proven.
Result<IntBox> blockRegion(const Program& program, int32_t cells);

/// The region of a statement: `in block(n)`, else `given`, else all of a finite world, else block(1).
Result<IntBox> regionOf(const Program& program, const Expectation& expectation, const std::optional<IntBox>& given);

/// kMeasuredCell, doubled until all boxes (lo <= p < hi, not empty) together have at most max_chunks chunks.
/// Error: limit if that needs cells of more than 1,024 m.
Result<int32_t> cellFor(std::span<const IntBox> boxes, uint64_t max_chunks);

}  // namespace sgm

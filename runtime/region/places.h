#pragma once
// Which part of a world a statement is about, and how finely it is sampled.

#include <optional>
#include <span>

#include "base/result.h"
#include "grammar/syntax/program.h"

namespace sgm {

inline constexpr int32_t kMeasuredCell = kUnitsPerMetre / 2;  ///< units; the finest cell that is chosen unasked
inline constexpr uint64_t kMeasuredChunks = 65536;            ///< the most chunks that are meshed unasked

/// `in block(n)`, as lo <= p < hi: n cells along each axis that is cut into cells, from cell 0 on, of the layer whose
/// cells are the largest by volume (of equal ones the first); along other axes what the layers are proven to reach.
/// Errors: limit where the block leaves the world, or where no bound is proven.
Result<IntBox> blockRegion(const Program& program, int32_t cells);

/// Where a statement looks: `in block(n)`; without it `given`; without that all of a finite world, or block(1).
Result<IntBox> regionOf(const Program& program, const Expectation& expectation, const std::optional<IntBox>& given);

/// kMeasuredCell, doubled until all boxes (lo <= p < hi, not empty) together have at most max_chunks chunks.
/// Error: limit where that takes cells of more than 1,024 m.
Result<int32_t> cellFor(std::span<const IntBox> boxes, uint64_t max_chunks);

}  // namespace sgm

#pragma once
// Finds a cell edge large enough that a region has no more chunks than allowed.

#include <optional>
#include <span>
#include <string>

#include "base/fixed.h"

namespace sgm {

/// Returns the number of chunks of 32 cells that meet the box lo <= p < hi; 2^63 - 1 if there are more. cell: edge in
/// units. Precondition: the box is not empty, and cell is positive.
uint64_t countChunks(const IntBox& region, int64_t cell);

/// The maximum number of chunks of one region, regardless of the caller's limit: a chunk takes at least half a kilobyte
/// even before it is meshed.
inline constexpr uint64_t kMaxRegionChunks = uint64_t{1} << 24;

/// Returns the smallest round cell edge in metres (1, 1.2, 1.5, 2 and so on, times a power of ten), not below `cell`
/// (units), at which the boxes together meet at most max_chunks chunks of a level; nullopt if no edge up to 1 km is
/// large enough.
std::optional<double> fittingCell(std::span<const IntBox> regions, int level, int32_t cell, uint64_t max_chunks);

/// Returns a part of an error message that advises larger cells, such as " (cells of 2 m fit)"; empty if none fit.
std::string fittingCellText(std::span<const IntBox> regions, int level, int32_t cell, uint64_t max_chunks);

}  // namespace sgm

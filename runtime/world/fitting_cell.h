#pragma once
// Which cells a region is not too large for.

#include <optional>
#include <span>
#include <string>

#include "base/fixed.h"

namespace sgm {

/// How many chunks of 32 cells of an edge meet the box lo <= p < hi; 2^63 - 1 where there are more. Precondition: the
/// box is not empty, cell is positive.
uint64_t countChunks(const IntBox& region, int64_t cell);

/// The most chunks of one region, whatever the caller allows: what a machine holds with half a kilobyte and more a
/// chunk, before any mesh.
inline constexpr uint64_t kMostRegionChunks = uint64_t{1} << 24;

/// The smallest of the round edges (1, 1.2, 1.5, 2 and so on, times a power of ten), metres, not below `cell` (units),
/// with which at most max_chunks chunks of a level meet all the boxes together; nullopt if none up to 1 km does.
std::optional<double> fittingCell(std::span<const IntBox> regions, int level, int32_t cell, uint64_t max_chunks);

/// " (cells of 2 m fit)" for a message that advises larger cells; empty if none fit.
std::string fittingCellText(std::span<const IntBox> regions, int level, int32_t cell, uint64_t max_chunks);

}  // namespace sgm

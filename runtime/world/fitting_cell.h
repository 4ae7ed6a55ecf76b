#pragma once
// Finds the cell edge at which a region has few enough chunks.

#include <optional>
#include <span>
#include <string>

#include "base/fixed.h"

namespace sgm {

/// The number of chunks of 32 cells that meet the box lo <= p < hi; 2^63 - 1 if there are more. Precondition: the box
/// is not empty, cell is positive.
uint64_t countChunks(const IntBox& region, int64_t cell);

/// The upper limit for chunks of one region, whatever the caller allows: a chunk takes half a kilobyte and more, before
/// any mesh.
inline constexpr uint64_t kMostRegionChunks = uint64_t{1} << 24;

/// The smallest round edge (1, 1.2, 1.5, 2 and so on, times a power of ten) in metres, not below `cell` (units), at
/// which the boxes together meet at most max_chunks chunks of a level; nullopt if none up to 1 km does.
std::optional<double> fittingCell(std::span<const IntBox> regions, int level, int32_t cell, uint64_t max_chunks);

/// " (cells of 2 m fit)", for an error message that advises larger cells; empty if none fit.
std::string fittingCellText(std::span<const IntBox> regions, int level, int32_t cell, uint64_t max_chunks);

}  // namespace sgm

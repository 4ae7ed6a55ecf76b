#include "world/fitting_cell.h"

#include <algorithm>
#include <array>
#include <limits>

#include "grammar/text/sink.h"
#include "mesh/chunk.h"

namespace sgm {

uint64_t countChunks(const IntBox& region, int64_t cell) {
  const int64_t edge = kChunkCells * cell;
  // The number of chunks along each axis can be almost 2^28, so the product of the three numbers may overflow an
  // integer.
  long double count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t first = floorDiv(region.lo[axis], edge), last = floorDiv(int64_t{region.hi[axis]} - 1, edge);
    count *= static_cast<long double>(last - first + 1);
  }
  constexpr uint64_t kMost = std::numeric_limits<int64_t>::max();
  return count < static_cast<long double>(kMost) ? static_cast<uint64_t>(count) : kMost;
}

std::optional<double> fittingCell(std::span<const IntBox> regions, int level, int32_t cell, uint64_t max_chunks) {
  constexpr std::array kRound{10, 12, 15, 20, 25, 30, 40, 50, 60, 80};
  constexpr int64_t kThousandths = 1'000'000;  // 1 km, in millimetres
  const auto fits = [&](int64_t units) {
    uint64_t chunks = 0;
    return std::all_of(regions.begin(), regions.end(), [&](const IntBox& region) {
      chunks = std::min(chunks + countChunks(region, units << level), max_chunks + 1);
      return chunks <= max_chunks;
    });
  };
  for (int64_t power = 1; power <= kThousandths; power *= 10) {
    for (const int round : kRound) {
      const int64_t tenths = round * power;  // cell edge in tenths of a millimetre
      const int64_t units = (tenths * kUnitsPerMetre + 5000) / 10'000;
      if (tenths > 10 * kThousandths || units < cell) continue;
      if (fits(units)) return static_cast<double>(tenths) / 10'000;
    }
  }
  return std::nullopt;
}

std::string fittingCellText(std::span<const IntBox> regions, int level, int32_t cell, uint64_t max_chunks) {
  const std::optional<double> edge = fittingCell(regions, level, cell, max_chunks);
  return edge ? " (cells of " + numberText(*edge) + " m fit)" : std::string();
}

}  // namespace sgm

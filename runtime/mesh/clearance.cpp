#include "mesh/clearance.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <span>

namespace sgm {

namespace {

constexpr int kLast = kChunkSamples - 1;
constexpr size_t kPitch = 40;  // number of values per row in memory, rounded up to a whole number of SIMD vectors
constexpr uint64_t kOwnSamples = (uint64_t{1} << kChunkCells) - 1;

/// Computes the squared distance from each sample to the nearest solid sample, first along x, then along y, then along
/// z. Each step uses only the results of the step before: the nearest solid sample in a plane is also the nearest in
/// its row of that plane (Felzenszwalb and Huttenlocher, Distance Transforms of Sampled Functions). Searches the whole
/// window of 2 reach + 1 samples, since it is too short for the lower envelope of that paper to be faster.
class SquaredDistances {
 public:
  SquaredDistances(const ChunkSignsAround& around, int most, std::pmr::memory_resource* memory)
      : around_(around), most_(static_cast<int16_t>(most)), memory_(memory) {
    while ((reach_ + 1) * (reach_ + 1) < most) ++reach_;
  }

  std::pmr::vector<uint16_t> run() const {
    const auto side = static_cast<size_t>(kChunkSamples + 2 * reach_);  // number of examined samples along each axis
    std::pmr::vector<int16_t> rows(side * side * kPitch, most_, memory_);
    for (size_t z = 0; z < side; ++z) {
      for (size_t y = 0; y < side; ++y)
        alongRow(static_cast<int>(y) - reach_, static_cast<int>(z) - reach_, &rows[(z * side + y) * kPitch]);
    }
    std::pmr::vector<int16_t> planes(side * kChunkSamples * kPitch, most_, memory_);
    for (size_t z = 0; z < side; ++z) {
      for (size_t y = 0; y < kChunkSamples; ++y)
        nearest(&rows[(z * side + y) * kPitch], kPitch, &planes[(z * kChunkSamples + y) * kPitch]);
    }
    std::pmr::vector<uint16_t> all(kChunkSamples * kChunkSamples * kChunkSamples, memory_);
    std::array<int16_t, kPitch> row{};
    for (size_t z = 0, i = 0; z < kChunkSamples; ++z) {
      for (size_t y = 0; y < kChunkSamples; ++y, i += kChunkSamples) {
        row.fill(most_);
        nearest(&planes[(z * kChunkSamples + y) * kPitch], kPitch * kChunkSamples, row.data());
        for (size_t x = 0; x < kChunkSamples; ++x) all[i + x] = static_cast<uint16_t>(row[x]);
      }
    }
    return all;
  }

 private:
  static int chunkOf(int sample) { return sample < 0 ? 0 : sample > kLast ? 2 : 1; }

  /// Writes, for each sample of row (y, z), the squared distance to the nearest solid sample of the row. The row is one
  /// of the middle chunk, or up to reach_ samples beyond it.
  void alongRow(int y, int z, int16_t* values) const {
    const int j = chunkOf(y), k = chunkOf(z);
    const auto row = [&](int i) {
      return around_[static_cast<size_t>(i + 3 * j + 9 * k)]->row(y - (j - 1) * kChunkCells, z - (k - 1) * kChunkCells);
    };
    const uint64_t own = row(1);
    // The row continues in the chunks at lower x and higher x. Each contributes all of its samples except the one in
    // the face that it shares with the middle chunk.
    const uint64_t low = reach_ > 0 ? row(0) & kOwnSamples : 0, high = reach_ > 0 ? row(2) >> 1 : 0;
    if ((own | low | high) == 0) return;
    int away = low != 0 ? std::countl_zero(low) - (64 - kChunkCells) : 2 * kChunkCells;
    std::array<int, kChunkSamples> least{};
    for (int x = 0; x <= kLast; ++x) {
      away = (own >> x & 1) != 0 ? 0 : away + 1;
      least[static_cast<size_t>(x)] = away;
    }
    away = high != 0 ? std::countr_zero(high) : 2 * kChunkCells;
    for (int x = kLast; x >= 0; --x) {
      away = (own >> x & 1) != 0 ? 0 : away + 1;
      const int d = std::min(away, least[static_cast<size_t>(x)]);
      values[x] = static_cast<int16_t>(std::min<int>(d * d, most_));
    }
  }

  /// One step of the transform. For 2 reach + 1 rows from `from` on, adds to each row's values the squared distance of
  /// the row from the middle row, and writes the minimum of these sums to `to`.
  void nearest(const int16_t* from, size_t pitch, int16_t* to) const {
    for (int d = -reach_; d <= reach_; ++d, from += pitch) {
      const auto square = static_cast<int16_t>(d * d);
      for (size_t x = 0; x < kPitch; ++x) to[x] = std::min(to[x], static_cast<int16_t>(from[x] + square));
    }
  }

  const ChunkSignsAround& around_;
  const int16_t most_;
  std::pmr::memory_resource* memory_;
  int reach_ = 0;  ///< search distance in samples: beyond it, squared distances are at least most_
};

}  // namespace

std::pmr::vector<uint16_t> squaredClearance(const ChunkSignsAround& around, int most,
                                            std::pmr::memory_resource* memory) {
  constexpr size_t kSamples = kChunkSamples * kChunkSamples * kChunkSamples;
  const auto isAll = [](const ChunkSigns* chunk, bool solid) { return chunk->rows.empty() && chunk->solid == solid; };
  const ChunkSigns* middle = around[13];
  if (isAll(middle, true)) return std::pmr::vector<uint16_t>(kSamples, 0, memory);
  const std::span<const ChunkSigns* const> seen =
      most > 1 ? std::span<const ChunkSigns* const>(around) : std::span<const ChunkSigns* const>(&middle, 1);
  if (std::ranges::all_of(seen, [&](const ChunkSigns* chunk) { return isAll(chunk, false); }))
    return std::pmr::vector<uint16_t>(kSamples, static_cast<uint16_t>(most), memory);
  return SquaredDistances(around, most, memory).run();
}

std::pmr::vector<uint64_t> rowsBelow(const std::pmr::vector<uint16_t>& clearance, int need) {
  std::pmr::vector<uint64_t> rows(size_t{kChunkSamples} * kChunkSamples, clearance.get_allocator());
  for (size_t row = 0, i = 0; row < rows.size(); ++row) {
    for (size_t x = 0; x < kChunkSamples; ++x, ++i) rows[row] |= uint64_t{clearance[i] < need} << x;
  }
  return rows;
}

}  // namespace sgm

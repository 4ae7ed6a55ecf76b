#pragma once
// Cells, or samples, of a chunk and near it, as bits in the order of a body's cells: z, then y, then x.

#include <bit>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "mesh/chunk.h"

namespace sgm {

/// Throws std::bad_alloc.
class CellSet {
 public:
  static constexpr int32_t kBelow = 16;         ///< cells on each axis lie at -kBelow or above,
  static constexpr int32_t kEnd = 64 - kBelow;  ///< and below kEnd

  explicit CellSet(std::pmr::memory_resource* memory) : rows_(64 * 64, memory), before_(memory) {}

  static uint32_t codeOf(const Int3& cell) {
    return static_cast<uint32_t>((cell.z + kBelow) << 12 | (cell.y + kBelow) << 6 | (cell.x + kBelow));
  }

  void add(const Int3& cell) { rows_[codeOf(cell) >> 6] |= uint64_t{1} << (codeOf(cell) & 63); }
  /// A cell and all cells within `reach` of it, 0 or more, which all lie within the bounds.
  void addAround(const Int3& cell, int32_t reach) {
    const uint64_t run = ((uint64_t{1} << (2 * reach + 1)) - 1) << (cell.x - reach + kBelow);
    for (int32_t z = cell.z - reach; z <= cell.z + reach; ++z)
      for (int32_t y = cell.y - reach; y <= cell.y + reach; ++y) rows_[codeOf({-kBelow, y, z}) >> 6] |= run;
  }
  bool has(const Int3& cell) const { return (rows_[codeOf(cell) >> 6] >> (codeOf(cell) & 63) & 1) != 0; }

  /// Calls visit(cell) for each in order.
  template <class Visit>
  void forEach(const Visit& visit) const {
    for (uint32_t row = 0; row < rows_.size(); ++row) {
      for (uint64_t left = rows_[row]; left != 0; left &= left - 1) {
        visit(Int3{std::countr_zero(left) - kBelow, static_cast<int32_t>(row & 63) - kBelow,
                   static_cast<int32_t>(row >> 6) - kBelow});
      }
    }
  }

  /// Makes placeOf() ready. Returns how many there are.
  uint32_t number() {
    before_.resize(rows_.size());
    uint32_t count = 0;
    for (size_t row = 0; row < rows_.size(); ++row) {
      before_[row] = count;
      count += static_cast<uint32_t>(std::popcount(rows_[row]));
    }
    return count;
  }
  /// Of a member, in the order of forEach().
  uint32_t placeOf(const Int3& cell) const {
    const uint32_t code = codeOf(cell);
    const uint64_t lower = rows_[code >> 6] & ((uint64_t{1} << (code & 63)) - 1);
    return before_[code >> 6] + static_cast<uint32_t>(std::popcount(lower));
  }

 private:
  std::pmr::vector<uint64_t> rows_;
  std::pmr::vector<uint32_t> before_;  ///< members in earlier rows
};

}  // namespace sgm

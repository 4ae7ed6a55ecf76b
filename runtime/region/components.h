#pragma once
// How many connected pieces the solid and the void of a block of samples have.
//
// Pieces are those that the mesh has, so they follow its rule for faces of a cell (mesh/case_rule.h): there every run
// of solid corners is cut off by itself. So solid samples join along the axes alone, and void samples also across the
// diagonal of a face: where its other two corners are solid the rule lets the void through, and where one of them is
// void the axes join all three. Nothing joins through the inside of a cell: each loop of a case closes one disk there,
// and disks part a cell as their loops part its surface.

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/fixed.h"

namespace sgm {

struct Components {
  uint64_t solid = 0, air = 0;
  friend bool operator==(const Components&, const Components&) = default;
};

/// A connected piece, in samples of the block.
struct Piece {
  uint64_t samples = 0;
  IntBox box;  ///< around its samples, which lie on the box's faces

  friend bool operator==(const Piece&, const Piece&) = default;
};

/// The smallest ones first; of equal ones that with the lowest corner, by z, then y, then x.
struct Pieces {
  std::vector<Piece> solid, air;

  /// How many have more samples than that.
  Components above(double samples) const;
  friend bool operator==(const Pieces&, const Pieces&) = default;
};

/// Those with more samples than that. pieces: as Pieces has them.
std::span<const Piece> largerThan(std::span<const Piece> pieces, double samples);

/// Counts plane by plane, and remembers no more than the last plane, and how large and where the pieces before it were.
class ComponentCounter {
 public:
  /// Of nx by ny samples a plane, at least one each.
  ComponentCounter(size_t nx, size_t ny, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

  /// Words of a row in a plane.
  static size_t rowWords(size_t nx) { return (nx + 63) / 64; }

  /// The next plane: ny rows of rowWords(nx) words. Bit x % 64 of word x / 64 is set where sample x is solid; bits from
  /// nx on may be anything. About one step a run of equal signs, near enough constant.
  void addPlane(std::span<const uint64_t> signs);

  /// Of all planes so far.
  Pieces pieces() const;

 private:
  /// Equal signs side by side: samples begin <= x < end of one row.
  struct Run {
    uint32_t begin = 0, end = 0;
    uint32_t piece = 0;  ///< into parent_
    bool solid = false;
  };
  struct Plane {
    std::pmr::vector<Run> runs;
    std::pmr::vector<size_t> first;  ///< of each row, and the end

    explicit Plane(std::pmr::memory_resource* memory) : runs(memory), first(memory) {}
    std::span<const Run> row(size_t y) const { return std::span(runs).subspan(first[y], first[y + 1] - first[y]); }
  };

  void findRuns(std::span<const uint64_t> signs);
  /// Joins what touches: void also where it is `diagonal` samples (0 or 1) off. solid: whether solid runs join at all.
  void joinRows(std::span<const Run> a, std::span<const Run> b, uint32_t diagonal, bool solid);
  void join(uint32_t a, uint32_t b);
  uint32_t rootOf(uint32_t piece);
  void retire();

  size_t nx_, ny_;
  Plane last_, next_;
  uint32_t open_ = 0;                  ///< pieces that the last plane has
  std::pmr::vector<uint32_t> parent_;  ///< union-find over the pieces of the last plane, then the runs of the next
  std::pmr::vector<uint32_t> number_;
  struct Open {
    bool solid = false;
    Piece piece;
  };
  std::pmr::vector<Open> pieces_;  ///< that the last plane has
  Pieces closed_;                  ///< of those that it does not have, in no order
  int32_t planes_ = 0;
};

}  // namespace sgm

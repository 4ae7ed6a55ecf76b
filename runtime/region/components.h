#pragma once
// Counts the connected pieces of the solid and of the void in a block of samples.
//
// Pieces are those of the mesh, so they follow its rule for the faces of a cell (mesh/case_rule.h): each run of solid
// corners there is cut off separately. So solid samples connect only along the axes. Void samples connect also across
// the diagonal of a face: if its other two corners are solid, the rule lets the void through; if one of them is void,
// the axes connect all three. Nothing connects through the inside of a cell: each loop of a case closes one disk there,
// and disks divide a cell as their loops divide its surface.

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
  IntBox box;  ///< the smallest box of its samples

  friend bool operator==(const Piece&, const Piece&) = default;
};

/// Smallest first; equal ones by their lowest corner: z, then y, then x.
struct Pieces {
  std::vector<Piece> solid, air;

  /// The numbers of pieces with more samples than this.
  Components above(double samples) const;
  friend bool operator==(const Pieces&, const Pieces&) = default;
};

/// The pieces with more samples than this. pieces: a member of Pieces.
std::span<const Piece> largerThan(std::span<const Piece> pieces, double samples);

/// Counts plane by plane. Remembers only the last plane, and the sizes and boxes of the pieces before it.
class ComponentCounter {
 public:
  /// For planes of nx by ny samples, at least one each.
  ComponentCounter(size_t nx, size_t ny, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

  /// Words of a row in a plane.
  static size_t rowWords(size_t nx) { return (nx + 63) / 64; }

  /// Adds the next plane: ny rows of rowWords(nx) words. Bit x % 64 of word x / 64 is set if sample x is solid; bits
  /// from nx on are ignored. Takes about one step per run of equal signs, each in nearly constant time.
  void addPlane(std::span<const uint64_t> signs);

  /// The pieces of all planes so far.
  Pieces pieces() const;

 private:
  /// A run of equal signs: samples begin <= x < end of one row.
  struct Run {
    uint32_t begin = 0, end = 0;
    uint32_t piece = 0;  ///< into parent_
    bool solid = false;
  };
  struct Plane {
    std::pmr::vector<Run> runs;
    std::pmr::vector<size_t> first;  ///< index of each row's first run, and the end

    explicit Plane(std::pmr::memory_resource* memory) : runs(memory), first(memory) {}
    std::span<const Run> row(size_t y) const { return std::span(runs).subspan(first[y], first[y + 1] - first[y]); }
  };

  void findRuns(std::span<const uint64_t> signs);
  /// Joins touching runs; void runs also touch if they are `diagonal` samples (0 or 1) apart. solid: join solid runs,
  /// too.
  void joinRows(std::span<const Run> a, std::span<const Run> b, uint32_t diagonal, bool solid);
  void join(uint32_t a, uint32_t b);
  uint32_t rootOf(uint32_t piece);
  void retire();

  size_t nx_, ny_;
  Plane last_, next_;
  uint32_t open_ = 0;                  ///< number of pieces in the last plane
  std::pmr::vector<uint32_t> parent_;  ///< union-find over the pieces of the last plane, then the runs of the next
  std::pmr::vector<uint32_t> number_;
  struct Open {
    bool solid = false;
    Piece piece;
  };
  std::pmr::vector<Open> pieces_;  ///< pieces in the last plane
  Pieces closed_;                  ///< all other pieces, unordered
  int32_t planes_ = 0;
};

}  // namespace sgm

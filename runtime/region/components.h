#pragma once
// Counts the connected pieces of the solid and of the void in a block of samples.
//
// The pieces are those of the mesh, so they follow the mesh's rule for the faces of a cell (mesh/case_rule.h): on each
// face, every run of solid corners is cut off separately. So solid samples connect only along the axes. Void samples
// also connect across the diagonal of a face: if the other two corners of the face are solid, the rule connects the
// void between them; if one of them is void, the axes connect all three. No further connections exist through the
// inside of a cell: each loop of the surface on a cell's faces is closed by one disk inside the cell, and the disks
// divide the cell exactly as the loops divide its faces.

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

/// A connected piece. Lengths and positions are in samples.
struct Piece {
  uint64_t samples = 0;
  IntBox box;  ///< bounding box of the piece's samples

  friend bool operator==(const Piece&, const Piece&) = default;
};

/// The pieces of a block. Each list is sorted by the number of samples, smallest first; equally large pieces are sorted
/// by their lowest corner (z, then y, then x).
struct Pieces {
  std::vector<Piece> solid, air;

  /// Returns the numbers of solid and void pieces that have more than `samples` samples.
  Components above(double samples) const;
  friend bool operator==(const Pieces&, const Pieces&) = default;
};

/// Returns the pieces with more than `samples` samples. pieces: a sorted member of Pieces.
std::span<const Piece> largerThan(std::span<const Piece> pieces, double samples);

/// Counts pieces while planes are added one by one. Stores only the last plane, and the sizes and boxes of pieces.
class ComponentCounter {
 public:
  /// nx, ny: number of samples in a plane along each axis, at least 1.
  ComponentCounter(size_t nx, size_t ny, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

  /// Returns the number of 64-bit words that a row of nx samples takes.
  static size_t rowWords(size_t nx) { return (nx + 63) / 64; }

  /// Adds the next plane: ny rows of rowWords(nx) words. Bit x % 64 of word x / 64 is set if sample x is solid; bits
  /// from nx on are ignored. Takes nearly constant time per run of equal signs.
  void addPlane(std::span<const uint64_t> signs);

  /// Returns the pieces of all planes added so far.
  Pieces pieces() const;

 private:
  /// A run of equal signs in a row: samples begin <= x < end.
  struct Run {
    uint32_t begin = 0, end = 0;
    uint32_t piece = 0;  ///< index of the run's piece in parent_
    bool solid = false;
  };
  struct Plane {
    std::pmr::vector<Run> runs;
    /// for each row, the index of its first run; as the last element, the end of the last row's runs
    std::pmr::vector<size_t> first;

    explicit Plane(std::pmr::memory_resource* memory) : runs(memory), first(memory) {}
    std::span<const Run> row(size_t y) const { return std::span(runs).subspan(first[y], first[y + 1] - first[y]); }
  };

  void findRuns(std::span<const uint64_t> signs);
  /// Joins the pieces of two rows, run by run: runs of equal sign that overlap along x belong to one piece. diagonal: 1
  /// if two void runs are also joined where one ends directly before the other begins; otherwise 0. solid: whether to
  /// join solid runs, too.
  void joinRows(std::span<const Run> a, std::span<const Run> b, uint32_t diagonal, bool solid);
  void join(uint32_t a, uint32_t b);
  uint32_t rootOf(uint32_t piece);
  void retire();

  size_t nx_, ny_;
  Plane last_, next_;
  uint32_t open_ = 0;  ///< number of pieces in the last plane
  /// union-find over the pieces of the last plane, followed by the runs of the next plane
  std::pmr::vector<uint32_t> parent_;
  std::pmr::vector<uint32_t> number_;
  struct Open {
    bool solid = false;
    Piece piece;
  };
  std::pmr::vector<Open> pieces_;  ///< the pieces that reach the last plane, which may continue in later planes
  Pieces closed_;                  ///< the complete pieces, which do not reach the last plane; unsorted
  int32_t planes_ = 0;
};

}  // namespace sgm

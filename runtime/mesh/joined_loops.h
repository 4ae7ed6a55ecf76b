#pragma once
// The loops of a body's cells after ambiguous faces were joined (mesh/ambiguous_faces.h).

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "mesh/body_loops.h"
#include "mesh/triangulate_any.h"

namespace sgm {

/// Identifies a face of the grid by its normal axis and the cell on the face's high side.
struct FaceName {
  Int3 cell;
  int axis = 0;
  friend auto operator<=>(const FaceName& a, const FaceName& b) {
    return std::array{a.cell.z, a.cell.y, a.cell.x, int32_t{a.axis}} <=>
           std::array{b.cell.z, b.cell.y, b.cell.x, int32_t{b.axis}};
  }
  friend bool operator==(const FaceName&, const FaceName&) = default;

  std::array<Int3, 2> cells() const {
    Int3 below = cell;
    --below[axis];
    return {below, cell};
  }
  static std::array<FaceName, 6> of(const Int3& cell) {
    std::array<FaceName, 6> names;
    for (int k = 0; k < 3; ++k) {
      const auto low = static_cast<size_t>(2 * k);
      names[low] = names[low + 1] = {cell, k};
      ++names[low + 1].cell[k];
    }
    return names;
  }
};

struct AmbiguousFace {
  FaceName name;
  std::array<Int3, 2> solid;  ///< the two solid corners of the face, in units
  bool is_joined = true;      ///< true if the two solid corners are joined
};

/// A loop of one cell: its vertices, in 1/256 of a cell from the chunk's origin.
struct CellLoop {
  using Triangles = std::array<uint32_t, 3 * (kLongestBodyLoop - 2)>;

  std::array<LoopPoint, kLongestBodyLoop> points;
  int count = 0;

  /// True if the loop can be triangulated without a diagonal in a face of its cell.
  bool canTriangulate() const;
  /// Returns the loop's triangles, three vertices each. Stores them in `triangles`. Precondition: canTriangulate().
  std::span<const uint32_t> triangulated(Triangles& triangles) const;
};

/// The loops of one cell, sorted by the lowest edge number of each loop.
struct CellLoops {
  std::array<CellLoop, kCubeEdges / 3> all;
  size_t count = 0;

  std::span<const CellLoop> loops() const { return {all.data(), count}; }
};

/// The loops of all cells of a body, with some faces joined.
class JoinedLoops {
 public:
  /// Borrows the body.
  JoinedLoops(const BodyLoops& body, std::pmr::memory_resource* memory) : body_(body), faces_(memory) {}

  const BodyLoops& body() const { return body_; }
  /// Returns the cell face that contains two vertices of a loop. Precondition: such a face exists.
  FaceName faceOf(const SurfaceLoop& loop, uint32_t a, uint32_t b) const;
  /// Calls visit(loop, from, to) for every side of a cell's loops. A side leads from one vertex of a loop to the next.
  /// These are the loops before any faces are joined.
  template <class Visit>
  void visitSides(const Int3& cell, const Visit& visit) const {
    body_.visitWithin(cell, cell, [&](uint32_t number) {
      const SurfaceLoop& loop = body_.all()[number];
      for (uint32_t i = 0; i < loop.count; ++i) visit(loop, loop.vertices[i], loop.vertices[(i + 1) % loop.count]);
    });
  }

  /// faces: sorted by name, without duplicates.
  void setFaces(std::pmr::vector<AmbiguousFace>&& faces) { faces_ = std::move(faces); }
  std::span<const AmbiguousFace> faces() const { return faces_; }
  bool isJoined(const FaceName& name) const;
  bool isJoinedAt(const Int3& cell) const;
  /// Precondition: faces() contains a face of that name.
  void setJoined(const FaceName& name, bool is_joined) { faces_[numberOf(name)].is_joined = is_joined; }
  CellLoops loopsOf(const Int3& cell) const;

 private:
  static constexpr uint32_t kNone = UINT32_MAX;

  /// The segment of a loop in one face of a cell.
  struct Side {
    uint32_t from = 0, to = 0;
    uint32_t face = kNone;  ///< index of the joined face that the side lies in; kNone if its face is not joined
  };

  /// The sides of all loops of a cell, from which loopsOf() builds the loops.
  struct CellSides {
    std::array<Side, kCubeEdges> all;
    size_t count = 0;

    std::span<Side> sides() { return {all.data(), count}; }
  };

  uint32_t numberOf(const FaceName& name) const;
  CellSides sidesOf(const Int3& cell) const;

  const BodyLoops& body_;
  std::pmr::vector<AmbiguousFace> faces_;
};

}  // namespace sgm

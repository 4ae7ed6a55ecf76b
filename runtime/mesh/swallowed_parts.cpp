#include "mesh/swallowed_parts.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "mesh/column.h"

namespace sgm {
namespace {

/// Union-find over vertices: connects the vertices of triangles, so that each part of the surface is identified by one
/// vertex.
class Parts {
 public:
  Parts(const BodyLoops& body, std::pmr::memory_resource* memory) : above_(body.part().vertices.size(), memory) {
    std::iota(above_.begin(), above_.end(), 0);
    for (const SurfaceLoop& loop : body.all())
      for (uint32_t i = 1; i < loop.count; ++i) join(loop.vertices[0], loop.vertices[i]);
  }

  uint32_t of(uint32_t vertex) {
    while (above_[vertex] != vertex) vertex = above_[vertex] = above_[above_[vertex]];
    return vertex;
  }

 private:
  void join(uint32_t a, uint32_t b) {
    a = of(a), b = of(b);
    above_[std::max(a, b)] = std::min(a, b);
  }

  std::pmr::vector<uint32_t> above_;  ///< union-find parent of each vertex: another vertex of its part, or itself
};

/// Returns the number of triangles above a point, along z, that face up, minus the number of those that face down.
int turnsAbove(std::span<const NamedTriangle> triangles, const Int3& place) {
  int turns = 0;
  for (const NamedTriangle& triangle : triangles) {
    const std::array<Int3, 3>& t = triangle.at;
    const int turn = turnOver<IntegerSigns>(t, place);
    if (turn != 0 && turn * IntegerSigns::orientation(t[0], t[1], t[2], place) > 0) turns += turn;
  }
  return turns;
}

class Swallowed {
 public:
  Swallowed(SharpLoops& sharp, std::pmr::memory_resource* memory)
      : sharp_(sharp), body_(sharp.body), parts_(sharp.body, memory), memory_(memory) {}

  bool round() {
    place_.assign(body_.all().size(), SharpLoops::kNone);
    for (uint32_t i = 0; i < sharp_.loops.size(); ++i) place_[sharp_.loops[i].loop] = i;
    bool any = false;
    for (const auto& [part, box] : closedParts()) {
      if (turnsOf(part, placeOf(body_.part(), part)) == 0) continue;
      visitOthers(part, box.lo, box.hi, [&](SharpLoop& loop) {
        if (!loop.isFan()) return;
        loop.shape = SharpLoop::Shape::rounded;
        any = true;
      });
    }
    return any;
  }

 private:
  struct ClosedPart {
    uint32_t vertex;
    PlaceBox cells;
  };

  /// Returns the parts of the surface that have no vertex in a face of the chunk.
  std::pmr::vector<ClosedPart> closedParts() {
    const MeshPart& part = body_.part();
    // for each part: the box of the cells that it occupies, indexed by the part's root vertex
    std::pmr::vector<PlaceBox> boxes(part.vertices.size(), memory_);
    for (const SurfaceLoop& loop : body_.all()) boxes[parts_.of(loop.vertices[0])].take(loop.cell);
    for (uint32_t v = 0; v < boxes.size(); ++v) {
      const Int3 at = placeOf(part, v);
      if (std::min({at.x, at.y, at.z}) == 0 || std::max({at.x, at.y, at.z}) == kChunkCells * kSubcell)
        boxes[parts_.of(v)] = {};
    }
    std::pmr::vector<ClosedPart> closed(memory_);
    for (uint32_t v = 0; v < boxes.size(); ++v)
      if (boxes[v].lo.x <= boxes[v].hi.x) closed.push_back({v, boxes[v]});
    return closed;
  }

  /// Calls visit for the sharp loops that do not belong to `part` and whose features may reach into the cells lo..hi.
  template <class Visit>
  void visitOthers(uint32_t part, Int3 lo, Int3 hi, const Visit& visit) {
    for (int k = 0; k < 3; ++k) --lo[k], ++hi[k];
    body_.visitWithin(lo, hi, [&](uint32_t number) {
      if (place_[number] != SharpLoops::kNone && parts_.of(body_.all()[number].vertices[0]) != part)
        visit(sharp_.loops[place_[number]]);
    });
  }

  /// Returns the change that the features of all parts except `part` cause in the winding number of these parts around
  /// a point. A loop's triangles with features and its triangles without features together form closed surfaces, except
  /// in the faces of the chunk; inTopFace() returns the triangles that are missing there.
  int turnsOf(uint32_t part, const Int3& at) {
    int turns = 0;
    const Int3 cell{at.x / kSubcell, at.y / kSubcell, at.z / kSubcell};
    visitOthers(part, {cell.x - 1, cell.y - 1, cell.z - 1}, {cell.x, cell.y, kChunkCells}, [&](const SharpLoop& loop) {
      if (!sharp_.centreOf(loop)) return;
      const LoopTriangles plain = plainTriangles(body_.part(), sharp_.of(loop));
      turns += turnsAbove(sharp_.trianglesOf(loop).all(), at) - turnsAbove(plain.all(), at);
      turns += turnsAbove(inTopFace(loop).all(), at);
    });
    return turns;
  }

  /// A side of a loop in the upper face of the chunk may be replaced by a path through face vertices. Returns the
  /// triangles in this face between the straight sides and their paths.
  LoopTriangles inTopFace(const SharpLoop& loop) const {
    LoopTriangles triangles;
    for (uint32_t i = 0; i < sharp_.of(loop).count; ++i) {
      if (loop.sides[i] == SharpSide::kNone) continue;
      const SharpSide& side = sharp_.sides[loop.sides[i]];
      if (!side.at_border || side.axis != 2 || side.places.empty()) continue;
      Int3 from = placeOf(body_.part(), side.from), to = placeOf(body_.part(), side.to);
      if (from.z != kChunkCells * kSubcell) continue;
      const bool is_forward = sharp_.of(loop).vertices[i] == side.from;
      for (const Int3& place : side.places.all()) {
        const Int3 middle = sharp_.fromChunk(side, place);
        triangles.add(is_forward ? std::array<Int3, 3>{from, to, middle} : std::array<Int3, 3>{to, from, middle}, {});
        from = middle;
      }
    }
    return triangles;
  }

  SharpLoops& sharp_;
  const BodyLoops& body_;
  Parts parts_;
  std::pmr::memory_resource* memory_;
  /// for each loop of the body: its index in sharp_.loops; kNone if the loop is not sharp
  std::pmr::vector<uint32_t> place_{memory_};
};

}  // namespace

bool roundAroundSwallowed(SharpLoops& sharp, std::pmr::memory_resource* memory) {
  return Swallowed(sharp, memory).round();
}

}  // namespace sgm

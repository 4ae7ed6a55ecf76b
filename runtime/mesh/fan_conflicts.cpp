#include "mesh/fan_conflicts.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "mesh/feature_reach.h"
#include "mesh/loop_triangles.h"

namespace sgm {
namespace {

constexpr uint32_t kNone = SharpLoops::kNone;
/// True if the fan, in a projection along one of a few directions, goes around its centre once and never turns back.
/// Then no two of its triangles overlap. Most fans around a cell vertex pass this quick test.
bool isSeenWhole(std::span<const NamedTriangle> fan) {
  // If the centre is one of the ring's own points, the fan does not go around it.
  if (fan.front().name[1] != fan.back().name[2]) return false;
  for (size_t i = 1; i < fan.size(); ++i)
    if (fan[i].name[0] != fan[0].name[0] || fan[i].name[1] != fan[i - 1].name[2]) return false;
  // The directions of projection that are tried: along the axes, and towards the octants.
  constexpr std::array<Int3, 7> kDirections{Int3{1, 0, 0},  Int3{0, 1, 0},  Int3{0, 0, 1}, Int3{1, 1, 1},
                                            Int3{1, 1, -1}, Int3{1, -1, 1}, Int3{-1, 1, 1}};
  std::array<std::array<int64_t, 3>, LoopTriangles::kMost> areas;
  for (size_t i = 0; i < fan.size(); ++i) {
    const Int3 &centre = fan[i].at[0], &from = fan[i].at[1], &to = fan[i].at[2];
    const int64_t ux = from.x - centre.x, uy = from.y - centre.y, uz = from.z - centre.z;
    const int64_t vx = to.x - centre.x, vy = to.y - centre.y, vz = to.z - centre.z;
    areas[i] = {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
  }
  for (const Int3& d : kDirections) {
    // Counts how often the fan goes around its centre in the projection along d. Consider a line through the centre in
    // this projection, with the normal `across`: each time around, the fan crosses the line once in the direction of
    // `across`.
    const Int3 across = d.x != 0 && d.y != 0 ? Int3{d.y, -d.x, 0}
                        : d.x != 0           ? Int3{0, 1, 0}
                        : d.y != 0           ? Int3{0, 0, 1}
                                             : Int3{1, 0, 0};
    int turn = 0, rounds = 0;
    bool same = true;
    for (size_t i = 0; i < fan.size() && same; ++i) {
      const Int3 &centre = fan[i].at[0], &from = fan[i].at[1], &to = fan[i].at[2];
      const int own = IntegerSigns::signOf(d.x * areas[i][0] + d.y * areas[i][1] + d.z * areas[i][2]);
      same = own != 0 && (turn == 0 || own == turn);
      turn = own;
      const auto side = [&](const Int3& p) {
        return across.x * (p.x - centre.x) + across.y * (p.y - centre.y) + across.z * (p.z - centre.z);
      };
      rounds += side(from) < 0 && side(to) >= 0;
    }
    if (same && rounds == 1) return true;
  }
  return false;
}

/// Finds pairs of loops that may intersect, by the bounding boxes of their features.
class Neighbours {
 public:
  Neighbours(const SharpLoops& sharp, std::pmr::memory_resource* memory)
      : sharp_(sharp), body_(sharp.body), place_(body_.all().size(), kNone, memory), features_(memory) {
    features_.reserve(sharp.loops.size());
    for (const SharpLoop& loop : sharp.loops) {
      place_[loop.loop] = static_cast<uint32_t>(features_.size());
      features_.push_back(featuresOf(loop));
    }
  }

  /// Returns the index in sharp_.loops of a loop of the body; kNone if the loop is not sharp.
  uint32_t placeOf(uint32_t loop) const { return place_[loop]; }

  /// Updates the boxes of sharp_.loops[place]. Call after the shape or the centre of that loop has changed.
  void update(uint32_t place) { features_[place] = featuresOf(sharp_.loops[place]); }

  /// Calls visit(number) for all other loops of the body that may intersect `loop`.
  template <class Visit>
  void visit(uint32_t loop, const Visit& visit) const {
    const PlaceBox own = boxOf(loop);
    Int3 lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = (own.lo[k] - kMaxOutside) >> 8;
      hi[k] = (own.hi[k] + kMaxOutside) >> 8;
    }
    visitCells(loop, own, lo, hi, visit);
  }

  /// Same as visit(), but visits fewer loops if isInside(loop): only loops of the same cell, and of the cells that
  /// share a face with it. A more distant loop can intersect `loop` only with a fan that leaves its own cell. The call
  /// of visitFromInside() for that distant loop then visits the pair.
  template <class Visit>
  void visitFromInside(uint32_t loop, const Visit& visit) const {
    if (!isInside(loop)) return this->visit(loop, visit);
    const Int3& cell = body_.all()[loop].cell;
    const PlaceBox own = boxOf(loop);
    visitCells(loop, own, {cell.x - 1, cell.y, cell.z}, {cell.x + 1, cell.y, cell.z}, visit);
    for (const int k : {1, 2}) {
      for (const int by : {-1, 1}) {
        Int3 beside = cell;
        beside[k] += by;
        visitCells(loop, own, beside, beside, visit);
      }
    }
  }
  /// True if visitFromInside(loop) visits `other`. Precondition: visit(loop) visits `other`.
  bool visitsFromInside(uint32_t loop, uint32_t other) const {
    const Int3 &at = body_.all()[loop].cell, &beside = body_.all()[other].cell;
    return std::abs(at.x - beside.x) + std::abs(at.y - beside.y) + std::abs(at.z - beside.z) <= 1 || !isInside(loop);
  }

 private:
  struct Boxes {
    /// `all`: box around all features of a loop, which are the fan's centre and the face vertices. `off_squares`: box
    /// around the features except those face vertices that lie inside the grid square (the cell face) of their own loop
    /// side.
    PlaceBox all, off_squares;
  };

  template <class Visit>
  void visitCells(uint32_t loop, const PlaceBox& own, const Int3& lo, const Int3& hi, const Visit& visit) const {
    body_.visitWithin(lo, hi, [&](uint32_t other) {
      if (other != loop && own.meets(boxOf(other)) && !areApart(loop, other)) visit(other);
    });
  }

  /// True if all features of a sharp loop lie in its cell, and the cell does not touch the chunk's border. A feature
  /// may lie in a face of the cell only if it is a face vertex inside the grid square of its own loop side.
  bool isInside(uint32_t loop) const {
    const Int3& cell = body_.all()[loop].cell;
    const Boxes& boxes = features_[place_[loop]];
    for (int k = 0; k < 3; ++k) {
      const int32_t lo = cell[k] * kSubcell, hi = lo + kSubcell;
      if (cell[k] == 0 || cell[k] == kChunkCells - 1 || boxes.all.lo[k] < lo || boxes.all.hi[k] > hi) return false;
      if (boxes.off_squares.lo[k] <= lo || boxes.off_squares.hi[k] >= hi) return false;
    }
    return true;
  }

  Boxes featuresOf(const SharpLoop& loop) const {
    Boxes boxes;
    if (loop.isFan()) boxes.all.take(loop.centre.at), boxes.off_squares.take(loop.centre.at);
    for (const uint32_t s : loop.sides) {
      if (s == kNone) continue;
      const SharpSide& side = sharp_.sides[s];
      for (const Int3& place : side.places.all()) {
        boxes.all.take(sharp_.fromChunk(side, place));
        if (!isInSquare(side.axis, place)) boxes.off_squares.take(sharp_.fromChunk(side, place));
      }
    }
    return boxes;
  }
  static bool isInSquare(int axis, const Int3& place) {
    for (int k = 0; k < 3; ++k)
      if (k == axis ? place[k] != 0 : place[k] <= 0 || place[k] >= kSubcell) return false;
    return true;
  }
  PlaceBox boxOf(uint32_t loop) const {
    const Int3& cell = body_.all()[loop].cell;
    PlaceBox box = place_[loop] == kNone ? PlaceBox{} : features_[place_[loop]].all;
    box.take({cell.x * kSubcell, cell.y * kSubcell, cell.z * kSubcell});
    box.take({(cell.x + 1) * kSubcell, (cell.y + 1) * kSubcell, (cell.z + 1) * kSubcell});
    return box;
  }
  /// True if a grid plane between the cells of two loops separates the loops. Only two things of the loops may lie in
  /// that plane: edges of marching-cubes loops, which never intersect, and face vertices inside the grid square of
  /// their own loop side. Face vertices of the two loops cannot collide there in two cases: the loops have different
  /// squares in the plane; or they share a side, and thus its face vertices.
  bool areApart(uint32_t a, uint32_t b) const {
    const Int3 &at = body_.all()[a].cell, &other = body_.all()[b].cell;
    for (int k = 0; k < 3; ++k) {
      if (std::abs(at[k] - other[k]) != 1) continue;
      const bool is_low = at[k] < other[k];
      const int32_t plane = std::max(at[k], other[k]) * kSubcell;
      Int3 across = other;
      across[k] = at[k];
      const bool is_strict = across == at && !shareSide(a, b);
      if (isBeside(is_low ? a : b, k, plane, true, is_strict) && isBeside(is_low ? b : a, k, plane, false, is_strict)) {
        return true;
      }
    }
    return false;
  }
  bool shareSide(uint32_t a, uint32_t b) const {
    if (place_[a] == kNone || place_[b] == kNone) return false;
    const auto& sides = sharp_.loops[place_[a]].sides;
    return std::any_of(sides.begin(), sides.end(), [&](uint32_t s) {
      return s != kNone && std::find(sharp_.sides[s].loops.begin(), sharp_.sides[s].loops.end(), place_[b]) !=
                               sharp_.sides[s].loops.end();
    });
  }
  bool isBeside(uint32_t loop, int axis, int32_t plane, bool below, bool is_strict) const {
    if (place_[loop] == kNone) return true;
    const Boxes& boxes = features_[place_[loop]];
    const PlaceBox& box = is_strict ? boxes.all : boxes.off_squares;
    return below ? box.hi[axis] < plane : box.lo[axis] > plane;
  }

  const SharpLoops& sharp_;
  const BodyLoops& body_;
  std::pmr::vector<uint32_t> place_;  ///< for each loop of the body: its index in sharp_.loops, or kNone
  std::pmr::vector<Boxes> features_;  ///< for each sharp loop: boxes in 1/256 of a cell, from the chunk's origin
};

/// Caches the current triangles of loops; computes them when they are first requested.
class PresentTriangles {
 public:
  PresentTriangles(const SharpLoops& sharp, const Neighbours& neighbours, std::pmr::memory_resource* memory)
      : sharp_(sharp),
        neighbours_(neighbours),
        at_(sharp.body.all().size(), memory),
        triangles_(memory),
        boxes_(memory) {
    triangles_.reserve(kUsual * sharp.loops.size());
    boxes_.reserve(kUsual * sharp.loops.size());
  }

  bool anyMeets(uint32_t a, uint32_t b) {
    make(a);
    make(b);
    return sgm::anyMeets(of(a), of(b));
  }
  /// Drops the cached triangles of a loop that has changed, and of the loops that share sides with it.
  void forget(const SharpLoop& loop) {
    at_[loop.loop].count = 0;
    for (const uint32_t s : loop.sides) {
      if (s == kNone) continue;
      for (const uint32_t other : sharp_.sides[s].loops)
        if (other != kNone) at_[sharp_.loops[other].loop].count = 0;
    }
  }

 private:
  static constexpr size_t kUsual = 8;  ///< usual number of triangles of a sharp loop, used to reserve memory

  /// The range of one loop's triangles in triangles_ and boxes_. `count` is 0 if the triangles are not cached.
  struct Range {
    uint32_t begin = 0, count = 0;
    PlaceBox box;
  };

  BoxedTriangles of(uint32_t number) const {
    const Range& range = at_[number];
    return {std::span(triangles_).subspan(range.begin, range.count),
            std::span(boxes_).subspan(range.begin, range.count), range.box};
  }
  void make(uint32_t number) {
    Range& range = at_[number];
    if (range.count > 0) return;
    const uint32_t place = neighbours_.placeOf(number);
    const LoopTriangles made = place != kNone ? sharp_.trianglesOf(sharp_.loops[place])
                                              : plainTriangles(sharp_.body.part(), sharp_.body.all()[number]);
    range = {static_cast<uint32_t>(triangles_.size()), static_cast<uint32_t>(made.count()), {}};
    for (const NamedTriangle& triangle : made.all()) {
      triangles_.push_back(triangle);
      boxes_.push_back(boxOf(triangle));
      range.box.take(boxes_.back().lo), range.box.take(boxes_.back().hi);
    }
  }

  const SharpLoops& sharp_;
  const Neighbours& neighbours_;
  std::pmr::vector<Range> at_;  ///< for each loop of the body: the range of its triangles
  std::pmr::vector<NamedTriangle> triangles_;
  std::pmr::vector<PlaceBox> boxes_;  ///< bounding box of each entry of triangles_
};

/// Returns how far the centre of a fan lies outside its cell, in 1/256 of a cell; negative if inside.
int32_t outsideOf(const SharpLoops& sharp, const SharpLoop& loop) {
  if (!loop.isFan()) return 0;
  const Int3& cell = sharp.of(loop).cell;
  int32_t outside = -kSubcell;
  for (int k = 0; k < 3; ++k) {
    const int32_t at = loop.centre.at[k] - cell[k] * kSubcell;
    outside = std::max({outside, -at, at - kSubcell});
  }
  return outside;
}

}  // namespace

bool hasFault(const LoopTriangles& fan) {
  const std::span<const NamedTriangle> all = fan.all();
  if (all.empty()) return true;
  if (isSeenWhole(all)) return false;
  for (size_t i = 0; i < all.size(); ++i) {
    if (!all[i].hasArea()) return true;
    for (size_t j = i + 1; j < all.size(); ++j)
      if (all[i].meets(all[j])) return true;
  }
  return false;
}

void roundUntilValid(SharpLoops& sharp, const std::function<bool(const LoopTriangles&)>& isSound,
                     const std::function<bool(SharpLoop&)>& takeNextCentre, std::pmr::memory_resource* memory) {
  Neighbours neighbours(sharp, memory);
  PresentTriangles present(sharp, neighbours, memory);
  const auto lacksVertex = [&](const SharpLoop& loop) {
    return std::any_of(loop.sides.begin(), loop.sides.end(), [&](uint32_t s) {
      return s != kNone && !sharp.sides[s].places.empty() && !sharp.hasFaceVertices(sharp.sides[s]);
    });
  };
  // dirty: indices of the sharp loops to be tested. tested_at, changed_at: for each sharp loop, the time of its last
  // test and of its last change. The clock `now` counts tests and changes.
  std::pmr::vector<uint32_t> dirty(sharp.loops.size(), memory), changed(memory);
  std::pmr::vector<uint64_t> tested_at(sharp.loops.size(), memory), changed_at(sharp.loops.size(), memory);
  // the entries of `dirty` in the order in which they are tested; each is a rank (high bits) and an index (low bits)
  std::pmr::vector<uint64_t> order(memory);
  uint64_t now = 0;
  std::iota(dirty.begin(), dirty.end(), 0);
  const auto visitSharing = [&](const SharpLoop& loop, const auto& visit) {
    for (const uint32_t s : loop.sides) {
      if (s == kNone || sharp.sides[s].places.empty()) continue;
      for (const uint32_t other : sharp.sides[s].loops)
        if (other != kNone) visit(other);
    }
  };
  while (!dirty.empty()) {
    // At a corner of the solid, many fans may have their centre at the same point. Only the loop whose cell contains
    // the point should keep it. So the loop with its centre farthest outside its cell is tested, and changed, first.
    order.clear();
    for (const uint32_t number : dirty) {
      const auto rank = static_cast<uint32_t>(kMaxOutside - outsideOf(sharp, sharp.loops[number]));
      order.push_back(uint64_t{rank} << 32 | number);
    }
    std::sort(order.begin(), order.end());
    changed.clear();
    for (const uint64_t ordered : order) {
      const auto number = static_cast<uint32_t>(ordered);
      SharpLoop& loop = sharp.loops[number];
      if (!loop.isFan()) continue;
      tested_at[number] = ++now;
      // The fan was sound when its loop had all of its face vertices. Changes of other loops may have removed some of
      // these vertices, so it is checked again.
      bool faulty = lacksVertex(loop) && !isSound(sharp.trianglesOf(loop));
      neighbours.visitFromInside(loop.loop, [&](uint32_t other) {
        if (faulty) return;
        const uint32_t place = neighbours.placeOf(other);
        // This pair of loops need not be tested again if the test of the other loop has included it, and neither loop
        // has changed since then.
        const bool is_known = place != kNone && sharp.loops[place].isFan() && tested_at[place] > changed_at[place] &&
                              tested_at[place] > changed_at[number] && neighbours.visitsFromInside(other, loop.loop);
        if (!is_known) faulty = present.anyMeets(loop.loop, other);
      });
      if (!faulty) continue;
      if (!takeNextCentre(loop)) loop.shape = SharpLoop::Shape::rounded;
      neighbours.update(number);
      present.forget(loop);
      changed_at[number] = ++now;
      visitSharing(loop, [&](uint32_t other) { changed_at[other] = now; });
      changed.push_back(number);
    }
    // The changes may have caused new intersections. So the next pass tests the changed loops, the loops that share
    // sides with them, and the neighbours of both.
    dirty.clear();
    const auto spread = [&](uint32_t number) {
      dirty.push_back(number);
      neighbours.visit(sharp.loops[number].loop, [&](uint32_t other) {
        if (neighbours.placeOf(other) != kNone) dirty.push_back(neighbours.placeOf(other));
      });
    };
    for (const uint32_t number : changed) {
      spread(number);
      visitSharing(sharp.loops[number], spread);
    }
    std::sort(dirty.begin(), dirty.end());
    dirty.erase(std::unique(dirty.begin(), dirty.end()), dirty.end());
  }
}

}  // namespace sgm

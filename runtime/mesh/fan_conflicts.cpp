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
/// Whether a fan, seen along some direction, goes round its centre once, and always the same way: then no two of its
/// triangles lie upon each other there. Most fans about a cell vertex do.
bool isSeenWhole(std::span<const NamedTriangle> fan) {
  // A fan about one of its own corners does not go round it.
  if (fan.front().name[1] != fan.back().name[2]) return false;
  // Along the axes, and from the eight octants.
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
    // Seen along d, a line through the centre: points on it have across . (p - centre) = 0.
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

/// Whether a triangle of a fan has no area or two meet wrongly.
bool hasFault(const LoopTriangles& fan) {
  const std::span<const NamedTriangle> all = fan.all();
  if (isSeenWhole(all)) return false;
  for (size_t i = 0; i < all.size(); ++i) {
    if (!all[i].hasArea()) return true;
    for (size_t j = i + 1; j < all.size(); ++j)
      if (all[i].meets(all[j])) return true;
  }
  return false;
}

/// Where the features of loops may lie, and which loops may meet for them.
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

  /// The place of a loop of the body among the sharp ones; kNone if it is not sharp.
  uint32_t placeOf(uint32_t loop) const { return place_[loop]; }

  /// After a change of the centre of a sharp loop.
  void update(uint32_t place) { features_[place] = featuresOf(sharp_.loops[place]); }

  /// Calls visit(number) for all loops that may meet a loop, but for the loop itself.
  template <class Visit>
  void visit(uint32_t loop, const Visit& visit) const {
    const PlaceBox own = boxOf(loop);
    Int3 lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = (own.lo[k] - kMostOutside) >> 8;
      hi[k] = (own.hi[k] + kMostOutside) >> 8;
    }
    body_.visitWithin(lo, hi, [&](uint32_t other) {
      if (other != loop && own.meets(boxOf(other)) && !areApart(loop, other)) visit(other);
    });
  }

 private:
  struct Boxes {
    PlaceBox all, off_squares;  ///< off_squares: without face vertices that lie in the inside of their side's square
  };

  Boxes featuresOf(const SharpLoop& loop) const {
    Boxes boxes;
    const auto take = [&boxes](const Int3& p) { boxes.all.take(p), boxes.off_squares.take(p); };
    if (loop.isFan()) take(loop.centre.at);
    for (const uint32_t s : loop.sides) {
      if (s == kNone || !sharp_.sides[s].place) continue;
      const SharpSide& side = sharp_.sides[s];
      boxes.all.take(sharp_.faceVertexAt(side));
      if (!isInSquare(side)) boxes.off_squares.take(sharp_.faceVertexAt(side));
    }
    return boxes;
  }
  static bool isInSquare(const SharpSide& side) {
    for (int k = 0; k < 3; ++k) {
      const int32_t at = (*side.place)[k];
      if (k == side.axis ? at != 0 : at <= 0 || at >= kSubcell) return false;
    }
    return true;
  }
  PlaceBox boxOf(uint32_t loop) const {
    const Int3& cell = body_.all()[loop].cell;
    PlaceBox box = place_[loop] == kNone ? PlaceBox{} : features_[place_[loop]].all;
    box.take({cell.x * kSubcell, cell.y * kSubcell, cell.z * kSubcell});
    box.take({(cell.x + 1) * kSubcell, (cell.y + 1) * kSubcell, (cell.z + 1) * kSubcell});
    return box;
  }
  /// Whether a plane between the cells has the features of each loop strictly on its own side, but for face vertices in
  /// the inside of their squares. In that plane both have what plain loops have there, which meet as they should, and
  /// those face vertices: in different squares, or in a square of which they share the side.
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
  std::pmr::vector<uint32_t> place_;  ///< in sharp_.loops, by loop of the body
  std::pmr::vector<Boxes> features_;  ///< by sharp loop, in 1/256 of a cell from the chunk's origin
};

/// The triangles that loops have now, made when they are asked for.
class PresentTriangles {
 public:
  PresentTriangles(const SharpLoops& sharp, const Neighbours& neighbours, std::pmr::memory_resource* memory)
      : sharp_(sharp),
        neighbours_(neighbours),
        at_(sharp.body.all().size(), kNone, memory),
        made_(memory),
        is_stale_(memory) {}

  /// Good until the next call.
  const LoopTriangles& of(uint32_t number) { return made_[made(number)]; }
  bool anyMeets(uint32_t a, uint32_t b) {
    const uint32_t at_a = made(a), at_b = made(b);
    return sgm::anyMeets(made_[at_a], made_[at_b]);
  }
  /// After a change of the loop.
  void forget(const SharpLoop& loop) {
    forget(loop.loop);
    for (const uint32_t s : loop.sides) {
      if (s == kNone) continue;
      for (const uint32_t other : sharp_.sides[s].loops)
        if (other != kNone) forget(sharp_.loops[other].loop);
    }
  }

 private:
  uint32_t made(uint32_t number) {
    uint32_t& at = at_[number];
    if (at == kNone) {
      at = static_cast<uint32_t>(made_.size());
      made_.push_back(make(number));
      is_stale_.push_back(false);
    } else if (is_stale_[at]) {
      made_[at] = make(number);
      is_stale_[at] = false;
    }
    return at;
  }
  void forget(uint32_t number) {
    if (at_[number] != kNone) is_stale_[at_[number]] = true;
  }
  LoopTriangles make(uint32_t number) const {
    const uint32_t place = neighbours_.placeOf(number);
    if (place != kNone) return sharp_.trianglesOf(sharp_.loops[place]);
    return plainTriangles(sharp_.body.part(), sharp_.body.all()[number]);
  }

  const SharpLoops& sharp_;
  const Neighbours& neighbours_;
  std::pmr::vector<uint32_t> at_;  ///< in made_, by loop
  std::pmr::vector<LoopTriangles> made_;
  std::pmr::vector<bool> is_stale_;  ///< of made_
};

/// How far the centre of a fan lies outside of its cell; less than 0 inside.
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

bool isSoundFan(const SharpLoops& sharp, const SharpLoop& loop, const FanCentre& centre) {
  return !hasFault(sharp.fullFan(loop, centre));
}

void roundUntilValid(SharpLoops& sharp, const std::function<bool(SharpLoop&)>& takeNextCentre,
                     std::pmr::memory_resource* memory) {
  Neighbours neighbours(sharp, memory);
  PresentTriangles present(sharp, neighbours, memory);
  const auto lacksVertex = [&](const SharpLoop& loop) {
    return std::any_of(loop.sides.begin(), loop.sides.end(), [&](uint32_t s) {
      return s != kNone && sharp.sides[s].place && !sharp.hasFaceVertex(sharp.sides[s]);
    });
  };
  // Numbers of sharp loops; and for each when it was tested last and when it changed, counted in tests.
  std::pmr::vector<uint32_t> dirty(sharp.loops.size(), memory), changed(memory);
  std::pmr::vector<uint64_t> tested_at(sharp.loops.size(), memory), changed_at(sharp.loops.size(), memory);
  uint64_t now = 0;
  std::iota(dirty.begin(), dirty.end(), 0);
  const auto visitSharing = [&](const SharpLoop& loop, const auto& visit) {
    for (const uint32_t s : loop.sides) {
      if (s == kNone || !sharp.sides[s].place) continue;
      for (const uint32_t other : sharp.sides[s].loops)
        if (other != kNone) visit(other);
    }
  };
  while (!dirty.empty()) {
    // Around a corner of the solid many loops have it for their centre: the one whose cell it is in shall keep it.
    std::sort(dirty.begin(), dirty.end(), [&](uint32_t a, uint32_t b) {
      const int32_t of_a = outsideOf(sharp, sharp.loops[a]), of_b = outsideOf(sharp, sharp.loops[b]);
      return of_a != of_b ? of_a > of_b : a < b;
    });
    changed.clear();
    for (const uint32_t number : dirty) {
      SharpLoop& loop = sharp.loops[number];
      if (!loop.isFan()) continue;
      tested_at[number] = ++now;
      // With all of its face vertices the fan is sound; some may be lost by now.
      bool faulty = lacksVertex(loop) && hasFault(present.of(loop.loop));
      neighbours.visit(loop.loop, [&](uint32_t other) {
        if (faulty) return;
        const uint32_t place = neighbours.placeOf(other);
        // The pair was tested, and neither has changed since.
        const bool is_known = place != kNone && sharp.loops[place].isFan() && tested_at[place] > changed_at[place] &&
                              tested_at[place] > changed_at[number];
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
    // A changed loop, and the loops that have lost a face vertex to it, lie beside others.
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

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
/// Whether a fan, seen along some axis, goes round its centre once, and always the same way: then no two of its
/// triangles lie upon each other there. Most fans about a cell vertex do.
bool isSeenWhole(std::span<const NamedTriangle> fan) {
  // A fan about one of its own corners does not go round it.
  if (fan.front().name[1] != fan.back().name[2]) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const int v = (axis + 2) % 3;
    int turn = 0, rounds = 0;
    bool same = true;
    for (size_t i = 0; i < fan.size() && same; ++i) {
      const auto& [centre, from, to] = fan[i].at;
      const int own = IntegerSigns::orientationAlong(axis, centre, from, to);
      same = own != 0 && (turn == 0 || own == turn);
      turn = own;
      rounds += from[v] < centre[v] && to[v] >= centre[v];
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
      : body_(sharp.body), sharp_(body_.all().size(), kNone, memory), features_(memory) {
    features_.reserve(sharp.loops.size());
    for (const SharpLoop& loop : sharp.loops) {
      sharp_[loop.loop] = static_cast<uint32_t>(features_.size());
      features_.push_back(featuresOf(sharp, loop));
    }
  }

  /// The place of a loop of the body among the sharp ones; kNone if it is not sharp.
  uint32_t placeOf(uint32_t loop) const { return sharp_[loop]; }

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
      if (other != loop && own.meets(boxOf(other)) && !isApart(loop, other)) visit(other);
    });
  }

 private:
  static PlaceBox featuresOf(const SharpLoops& sharp, const SharpLoop& loop) {
    PlaceBox box;
    if (loop.isFan()) box.take(loop.centre.at);
    for (const std::optional<FanCentre>& centre : loop.spares)
      if (centre) box.take(centre->at);
    for (const uint32_t s : loop.sides)
      if (s != kNone && sharp.sides[s].place) box.take(sharp.faceVertexAt(sharp.sides[s]));
    return box;
  }
  PlaceBox boxOf(uint32_t loop) const {
    const Int3& cell = body_.all()[loop].cell;
    PlaceBox box = sharp_[loop] == kNone ? PlaceBox{} : features_[sharp_[loop]];
    box.take({cell.x * kSubcell, cell.y * kSubcell, cell.z * kSubcell});
    box.take({(cell.x + 1) * kSubcell, (cell.y + 1) * kSubcell, (cell.z + 1) * kSubcell});
    return box;
  }
  /// Whether a plane between the cells has the features of each loop strictly on its own side. In that plane both have
  /// what plain loops have there, which meet as they should.
  bool isApart(uint32_t a, uint32_t b) const {
    const Int3 &at = body_.all()[a].cell, &other = body_.all()[b].cell;
    for (int k = 0; k < 3; ++k) {
      if (std::abs(at[k] - other[k]) != 1) continue;
      const bool is_low = at[k] < other[k];
      const int32_t plane = std::max(at[k], other[k]) * kSubcell;
      if (isBeside(is_low ? a : b, k, plane, true) && isBeside(is_low ? b : a, k, plane, false)) return true;
    }
    return false;
  }
  bool isBeside(uint32_t loop, int axis, int32_t plane, bool below) const {
    if (sharp_[loop] == kNone) return true;
    const PlaceBox& box = features_[sharp_[loop]];
    return below ? box.hi[axis] < plane : box.lo[axis] > plane;
  }

  const BodyLoops& body_;
  std::pmr::vector<uint32_t> sharp_;     ///< by loop
  std::pmr::vector<PlaceBox> features_;  ///< by sharp loop, in 1/256 of a cell from the chunk's origin
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
  const LoopTriangles& of(uint32_t number) {
    uint32_t& at = at_[number];
    if (at == kNone) {
      at = static_cast<uint32_t>(made_.size());
      made_.push_back(make(number));
      is_stale_.push_back(false);
    } else if (is_stale_[at]) {
      made_[at] = make(number);
      is_stale_[at] = false;
    }
    return made_[at];
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

void roundUntilValid(SharpLoops& sharp, std::pmr::memory_resource* memory) {
  const Neighbours neighbours(sharp, memory);
  PresentTriangles present(sharp, neighbours, memory);
  const auto lacksVertex = [&](const SharpLoop& loop) {
    return std::any_of(loop.sides.begin(), loop.sides.end(), [&](uint32_t s) {
      return s != kNone && sharp.sides[s].place && !sharp.hasFaceVertex(sharp.sides[s]);
    });
  };
  std::pmr::vector<uint32_t> dirty(sharp.loops.size(), memory), changed(memory);  // numbers of sharp loops
  std::iota(dirty.begin(), dirty.end(), 0);
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
      const LoopTriangles own = present.of(loop.loop);
      // With all of its face vertices the fan is sound; some may be lost by now.
      bool faulty = lacksVertex(loop) && hasFault(own);
      neighbours.visit(loop.loop, [&](uint32_t other) {
        if (!faulty) faulty = anyMeets(own, present.of(other));
      });
      if (!faulty) continue;
      if (loop.spares[0]) {
        loop.centre = *std::exchange(loop.spares[0], std::exchange(loop.spares[1], std::nullopt));
      } else {
        loop.shape = SharpLoop::Shape::rounded;
      }
      present.forget(loop);
      changed.push_back(number);
    }
    // What a changed loop is now, and the loops that have lost a face vertex to it, lie beside others.
    dirty.clear();
    for (const uint32_t number : changed) {
      dirty.push_back(number);
      neighbours.visit(sharp.loops[number].loop, [&](uint32_t near) {
        neighbours.visit(near, [&](uint32_t other) {
          if (neighbours.placeOf(other) != kNone) dirty.push_back(neighbours.placeOf(other));
        });
      });
    }
    std::sort(dirty.begin(), dirty.end());
    dirty.erase(std::unique(dirty.begin(), dirty.end()), dirty.end());
  }
}

}  // namespace sgm

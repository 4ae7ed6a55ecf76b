#include "mesh/fan_conflicts.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include "mesh/triangle_faults.h"

namespace sgm {
namespace {

constexpr uint32_t kNoSide = Features::kNone;

struct Box {
  Int3 lo, hi;
  static Box empty() { return {{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}}; }
  void take(const Int3& p) {
    for (int k = 0; k < 3; ++k) lo[k] = std::min(lo[k], p[k]), hi[k] = std::max(hi[k], p[k]);
  }
  bool meets(const Box& other) const {
    for (int k = 0; k < 3; ++k)
      if (lo[k] > other.hi[k] || other.lo[k] > hi[k]) return false;
    return true;
  }
};

constexpr uint32_t kFaceVertices = 1u << 30, kCellVertices = 1u << 31;  ///< names of feature vertices start there

/// When a loop has a triangle: if it is a fan; if it is one and the side has its face vertex, or has none; if it is
/// none.
enum class When : uint8_t { fan, with, without, plain };

struct Possible {
  std::array<Int3, 3> at;
  std::array<uint32_t, 3> name;  ///< of vertices: equal for those that are one
  When when;
  uint32_t side;  ///< that `when` speaks of; kNoSide: none
  Box box;

  bool hasArea() const { return IntegerSigns::seenAlong(at) >= 0; }
  bool meets(const Possible& other) const {
    if (!box.meets(other.box)) return false;
    std::array<Int3, 3> a = at, b = other.at;
    std::array<uint32_t, 3> names_a = name, names_b = other.name;
    int common = 0;
    for (size_t i = 0; i < 3; ++i) {
      for (auto j = static_cast<size_t>(common); j < 3; ++j) {
        if (names_a[i] != names_b[j]) continue;
        const auto first = static_cast<size_t>(common);
        std::swap(b[first], b[j]), std::swap(names_b[first], names_b[j]);
        std::swap(a[first], a[i]), std::swap(names_a[first], names_a[i]);
        ++common;
        break;
      }
    }
    return TrianglePair<IntegerSigns>::faultOf(a, b, common) != PairFault::none;
  }
};

/// Triangles of one loop, appended to a vector that others share.
class Triangles {
 public:
  explicit Triangles(std::pmr::vector<Possible>& store) : store_(&store), first_(store.size()) {}

  void add(const std::array<Int3, 3>& at, const std::array<uint32_t, 3>& name, When when, uint32_t side = kNoSide) {
    Possible& triangle = store_->emplace_back(Possible{at, name, when, side, Box::empty()});
    for (const Int3& p : at) triangle.box.take(p), box.take(p);
    ++count_;
  }
  std::span<const Possible> all() const { return {store_->data() + first_, count_}; }

  Box box = Box::empty();

 private:
  std::pmr::vector<Possible>* store_;
  size_t first_, count_ = 0;
};

/// Triangles of loops, or of fans, by number; made when they are asked for.
class MadeTriangles {
 public:
  MadeTriangles(size_t numbers, std::pmr::memory_resource* memory)
      : at_(numbers, kNoSide, memory), made_(memory), store_(memory) {
    constexpr size_t kSome = 512;
    store_.reserve(kSome);
  }

  /// Calls make(triangles) the first time. Good until the next call.
  template <class Make>
  const Triangles& of(size_t number, const Make& make) {
    if (at_[number] == kNoSide) {
      at_[number] = static_cast<uint32_t>(made_.size());
      make(made_.emplace_back(store_));
    }
    return made_[at_[number]];
  }
  void forget(size_t number) { at_[number] = kNoSide; }

 private:
  std::pmr::vector<uint32_t> at_;  ///< in made_
  std::pmr::vector<Triangles> made_;
  std::pmr::vector<Possible> store_;
};

/// Makes the triangles that loops can have.
class TriangleMaker {
 public:
  TriangleMaker(const SurfacePatch& patch, std::span<const SharpSide> sides) : patch_(patch), sides_(sides) {}

  /// In 1/256 of a cell from the patch's origin. Precondition: the side has a place.
  Int3 faceVertexAt(uint32_t s) const {
    Int3 at = *sides_[s].place;
    const ChunkGrid& grid = patch_.grid();
    for (int k = 0; k < 3; ++k) {
      at[k] += static_cast<int32_t>((int64_t{sides_[s].corner[k]} - grid.origin[k]) / grid.cell) * kSubcell;
    }
    return at;
  }

  void addPlain(uint32_t number, Triangles& triangles) const {
    const SurfaceLoop& loop = patch_.loops()[number];
    for (uint32_t i = loop.first_index; i < loop.end_index; i += 3) {
      const uint32_t* v = &patch_.part().indices[i];
      triangles.add({vertexAt(v[0]), vertexAt(v[1]), vertexAt(v[2])}, {v[0], v[1], v[2]}, When::plain);
    }
  }

  /// Calls has(side) for the sides that can have a face vertex: bit 0: with it; bit 1: without it. Precondition: the
  /// loop has a centre.
  template <class Has>
  void addFan(const SharpLoop& sharp, const Has& has, Triangles& triangles) const {
    const SurfaceLoop& loop = patch_.loops()[sharp.loop];
    const Int3 centre{loop.cell.x * kSubcell + sharp.centre->x, loop.cell.y * kSubcell + sharp.centre->y,
                      loop.cell.z * kSubcell + sharp.centre->z};
    const uint32_t name = kCellVertices + sharp.loop;
    for (uint32_t i = 0; i < loop.count; ++i) {
      const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count], s = sharp.sides[i];
      const bool can_have = s != kNoSide && sides_[s].place;
      const uint32_t states = can_have ? has(sides_[s]) : 2;
      if ((states & 2) != 0) {
        triangles.add({centre, vertexAt(a), vertexAt(b)}, {name, a, b}, can_have ? When::without : When::fan, s);
      }
      if ((states & 1) != 0) {
        const Int3 middle = faceVertexAt(s);
        triangles.add({centre, vertexAt(a), middle}, {name, a, kFaceVertices + s}, When::with, s);
        triangles.add({centre, middle, vertexAt(b)}, {name, kFaceVertices + s, b}, When::with, s);
      }
    }
  }

 private:
  Int3 vertexAt(uint32_t v) const {
    const Vertex& vertex = patch_.part().vertices[v];
    return {vertex.x, vertex.y, vertex.z};
  }
  const SurfacePatch& patch_;
  std::span<const SharpSide> sides_;
};

/// Where the features of loops may lie, and which loops may meet for them.
class Neighbours {
 public:
  Neighbours(const SurfacePatch& patch, std::span<const SharpSide> sides, std::span<const SharpLoop> loops,
             std::pmr::memory_resource* memory)
      : patch_(patch), sharp_(patch.loops().size(), kNoSide, memory), features_(memory) {
    features_.reserve(loops.size());
    for (const SharpLoop& loop : loops) {
      sharp_[loop.loop] = static_cast<uint32_t>(features_.size());
      features_.push_back(featuresOf(loop, sides));
    }
  }

  /// The place of a loop of the patch among the sharp ones; kNoSide if it is not sharp.
  uint32_t placeOf(uint32_t loop) const { return sharp_[loop]; }

  /// Calls visit(number) for all loops that may meet a loop, but for the loop itself.
  template <class Visit>
  void visit(uint32_t loop, const Visit& visit) const {
    const Box own = boxOf(loop);
    Int3 lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = (own.lo[k] - kMostOutside) >> 8;
      hi[k] = (own.hi[k] + kMostOutside) >> 8;
    }
    patch_.forLoops(lo, hi, [&](uint32_t other) {
      if (other != loop && own.meets(boxOf(other)) && !isApart(loop, other)) visit(other);
    });
  }

 private:
  Box featuresOf(const SharpLoop& loop, std::span<const SharpSide> sides) const {
    Box box = Box::empty();
    if (!loop.centre) return box;
    const Int3& cell = patch_.loops()[loop.loop].cell;
    for (const std::optional<Int3>& centre : {loop.centre, loop.spares[0], loop.spares[1]}) {
      if (!centre) continue;
      box.take({cell.x * kSubcell + centre->x, cell.y * kSubcell + centre->y, cell.z * kSubcell + centre->z});
    }
    const TriangleMaker maker(patch_, sides);
    for (const uint32_t s : loop.sides)
      if (s != kNoSide && sides[s].place) box.take(maker.faceVertexAt(s));
    return box;
  }
  Box boxOf(uint32_t loop) const {
    const Int3& cell = patch_.loops()[loop].cell;
    Box box = sharp_[loop] == kNoSide ? Box::empty() : features_[sharp_[loop]];
    box.take({cell.x * kSubcell, cell.y * kSubcell, cell.z * kSubcell});
    box.take({(cell.x + 1) * kSubcell, (cell.y + 1) * kSubcell, (cell.z + 1) * kSubcell});
    return box;
  }
  /// Whether a plane between the cells has the features of each loop strictly on its own side. In that plane both have
  /// what plain loops have there, which meet as they should.
  bool isApart(uint32_t a, uint32_t b) const {
    const Int3 &at = patch_.loops()[a].cell, &other = patch_.loops()[b].cell;
    for (int k = 0; k < 3; ++k) {
      if (std::abs(at[k] - other[k]) != 1) continue;
      const bool is_low = at[k] < other[k];
      const int32_t plane = std::max(at[k], other[k]) * kSubcell;
      if (isBeside(is_low ? a : b, k, plane, true) && isBeside(is_low ? b : a, k, plane, false)) return true;
    }
    return false;
  }
  bool isBeside(uint32_t loop, int axis, int32_t plane, bool below) const {
    if (sharp_[loop] == kNoSide) return true;
    const Box& box = features_[sharp_[loop]];
    return below ? box.hi[axis] < plane : box.lo[axis] > plane;
  }

  const SurfacePatch& patch_;
  std::pmr::vector<uint32_t> sharp_;  ///< by loop
  std::pmr::vector<Box> features_;    ///< by sharp loop, in 1/256 of a cell from the patch's origin
};

constexpr auto kAllVertices = [](const SharpSide&) { return 1u; };
constexpr auto kEitherWay = [](const SharpSide&) { return 3u; };

/// Whether a fan, seen along some axis, goes round its centre once, and always the same way: then no two of its
/// triangles lie upon each other there. Most fans do.
bool isSeenWhole(std::span<const Possible> fan) {
  for (int axis = 0; axis < 3; ++axis) {
    const int v = (axis + 2) % 3;
    int turn = 0, rounds = 0;
    bool same = true;
    for (size_t i = 0; i < fan.size() && same; ++i) {
      const auto& [centre, from, to] = fan[i].at;
      const int own = IntegerSigns::orientationAlong(axis, centre, from, to);
      same = own != 0 && (turn == 0 || own == turn);
      turn = own;
      // Both ways past a side that may have a face vertex are as long: one of them counts.
      const bool is_other_way = fan[i].when == When::without && i + 1 < fan.size() && fan[i + 1].side == fan[i].side;
      if (!is_other_way) rounds += from[v] < centre[v] && to[v] >= centre[v];
    }
    if (same && rounds == 1) return true;
  }
  return false;
}

/// Whether a triangle has no area or two meet wrongly, of those that one fan can have at one time.
bool hasFault(const Triangles& fan) {
  const std::span<const Possible> all = fan.all();
  if (isSeenWhole(all)) return false;
  for (size_t i = 0; i < all.size(); ++i) {
    if (!all[i].hasArea()) return true;
    for (size_t j = i + 1; j < all.size(); ++j) {
      const bool apart = all[i].side != kNoSide && all[i].side == all[j].side && all[i].when != all[j].when;
      if (!apart && all[i].meets(all[j])) return true;
    }
  }
  return false;
}

bool anyMeets(const Triangles& first, const Triangles& second) {
  if (!first.box.meets(second.box)) return false;
  for (const Possible& a : first.all()) {
    if (!a.box.meets(second.box)) continue;
    for (const Possible& b : second.all())
      if (a.meets(b)) return true;
  }
  return false;
}

/// The triangles that loops have now, made when they are asked for.
class PresentTriangles {
 public:
  PresentTriangles(const SurfacePatch& patch, const Neighbours& neighbours, std::span<const SharpSide> sides,
                   std::span<const SharpLoop> loops, std::pmr::memory_resource* memory)
      : maker_(patch, sides),
        neighbours_(neighbours),
        sides_(sides),
        loops_(loops),
        made_(patch.loops().size(), memory) {}

  /// Good until the next call.
  const Triangles& of(uint32_t number) {
    return made_.of(number, [&](Triangles& triangles) {
      const uint32_t place = neighbours_.placeOf(number);
      if (place != kNoSide && isFan(loops_[place])) {
        maker_.addFan(
            loops_[place], [&](const SharpSide& side) { return hasVertex(side) ? 1u : 2u; }, triangles);
      } else {
        maker_.addPlain(number, triangles);
      }
    });
  }
  /// After a change of the loop.
  void forget(const SharpLoop& loop) {
    made_.forget(loop.loop);
    for (const uint32_t s : loop.sides) {
      if (s == kNoSide) continue;
      for (const uint32_t other : sides_[s].loops)
        if (other != kNoSide) made_.forget(loops_[other].loop);
    }
  }

  static bool isFan(const SharpLoop& loop) { return loop.centre && !loop.rounded; }
  bool hasAllVertices(const SharpLoop& loop) const {
    return std::all_of(loop.sides.begin(), loop.sides.end(),
                       [&](uint32_t s) { return s == kNoSide || !sides_[s].place || hasVertex(sides_[s]); });
  }

 private:
  bool hasVertex(const SharpSide& side) const {
    return std::all_of(side.loops.begin(), side.loops.end(),
                       [&](uint32_t loop) { return loop == kNoSide || isFan(loops_[loop]); });
  }

  const TriangleMaker maker_;
  const Neighbours& neighbours_;
  std::span<const SharpSide> sides_;
  std::span<const SharpLoop> loops_;
  MadeTriangles made_;
};

}  // namespace

FanConflicts::FanConflicts(const SurfacePatch& patch, std::span<const SharpSide> sides, std::span<SharpLoop> loops,
                           std::pmr::memory_resource* memory)
    : patch_(patch), sides_(sides), loops_(loops), memory_(memory) {}

bool FanConflicts::isSound(const SharpLoop& loop) const {
  std::pmr::vector<Possible> store(memory_);
  Triangles fan(store);
  TriangleMaker(patch_, sides_).addFan(loop, kAllVertices, fan);
  return !hasFault(fan);
}

void FanConflicts::roundInAnyState(std::span<const uint32_t> numbers) {
  const TriangleMaker maker(patch_, sides_);
  const Neighbours neighbours(patch_, sides_, loops_, memory_);
  std::pmr::vector<Possible> store(memory_);
  const auto hasPlain = [](const SharpLoop& loop, const Possible& other) {
    // Beside a loop that is no fan no side of it has a face vertex.
    return other.when != When::with || std::find(loop.sides.begin(), loop.sides.end(), other.side) == loop.sides.end();
  };
  MadeTriangles plains(patch_.loops().size(), memory_), fans(loops_.size(), memory_);
  const auto fanOf = [&](uint32_t place) -> const Triangles& {
    return fans.of(place, [&](Triangles& fan) { maker.addFan(loops_[place], kEitherWay, fan); });
  };
  const auto meetsPlain = [&](const Triangles& fan, uint32_t number, const SharpLoop* other) {
    const Triangles& plain = plains.of(number, [&](Triangles& triangles) { maker.addPlain(number, triangles); });
    if (!fan.box.meets(plain.box)) return false;
    for (const Possible& a : fan.all())
      for (const Possible& b : plain.all())
        if ((other == nullptr || hasPlain(*other, a)) && a.meets(b)) return true;
    return false;
  };
  const auto meetsFan = [&](const Triangles& fan, const Triangles& second) {
    if (!fan.box.meets(second.box)) return false;
    for (const Possible& a : fan.all())
      for (const Possible& b : second.all())
        if ((a.side == kNoSide || a.side != b.side || a.when == b.when) && a.meets(b)) return true;
    return false;
  };
  for (const uint32_t number : numbers) {
    const uint32_t place = neighbours.placeOf(number);
    if (place == kNoSide || !loops_[place].centre) continue;
    SharpLoop& own = loops_[place];
    const Triangles fan = fanOf(place);
    own.rounded = own.rounded || hasFault(fan);
    neighbours.visit(number, [&](uint32_t other_number) {
      if (own.rounded) return;
      const uint32_t other_place = neighbours.placeOf(other_number);
      const SharpLoop* other = other_place == kNoSide ? nullptr : &loops_[other_place];
      own.rounded = meetsPlain(fan, other_number, other);
      if (own.rounded || other == nullptr || !other->centre) return;
      own.rounded = meetsFan(fan, fanOf(other_place));
      // Within a chunk a loop may come to have a spare centre.
      SharpLoop state = *other;
      for (const std::optional<Int3>& spare : other->spares) {
        if (own.rounded || !spare) return;
        state.centre = spare;
        Triangles second(store);
        maker.addFan(state, kEitherWay, second);
        own.rounded = meetsFan(fan, second);
      }
    });
  }
}

void FanConflicts::roundUntilValid(std::span<const uint32_t> numbers) {
  const Neighbours neighbours(patch_, sides_, loops_, memory_);
  PresentTriangles present(patch_, neighbours, sides_, loops_, memory_);
  std::pmr::vector<uint32_t> dirty(numbers.begin(), numbers.end(), memory_), changed(memory_);
  while (!dirty.empty()) {
    changed.clear();
    for (const uint32_t number : dirty) {
      const uint32_t place = neighbours.placeOf(number);
      if (place == kNoSide || !PresentTriangles::isFan(loops_[place])) continue;
      const Triangles own = present.of(number);
      // With all of its face vertices the fan is sound; some may be lost by now.
      bool faulty = !present.hasAllVertices(loops_[place]) && hasFault(own);
      neighbours.visit(number, [&](uint32_t other) {
        if (!faulty) faulty = anyMeets(own, present.of(other));
      });
      if (!faulty) continue;
      SharpLoop& loop = loops_[place];
      loop.rounded = !loop.spares[0];
      if (!loop.rounded) loop.centre = std::exchange(loop.spares[0], std::exchange(loop.spares[1], std::nullopt));
      present.forget(loop);
      changed.push_back(number);
    }
    // What a changed loop is now, and the loops that have lost a face vertex to it, lie beside others.
    dirty.clear();
    for (const uint32_t number : changed) {
      dirty.push_back(number);
      neighbours.visit(number, [&](uint32_t near) {
        neighbours.visit(near, [&](uint32_t other) {
          if (std::binary_search(numbers.begin(), numbers.end(), other)) dirty.push_back(other);
        });
      });
    }
    std::sort(dirty.begin(), dirty.end());
    dirty.erase(std::unique(dirty.begin(), dirty.end()), dirty.end());
  }
}

}  // namespace sgm

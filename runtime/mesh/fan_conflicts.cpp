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

/// Makes the triangles that loops can have.
class TriangleMaker {
 public:
  TriangleMaker(const SurfacePatch& patch, std::span<const SharpSide> sides) : patch_(patch), sides_(sides) {}

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
  Int3 faceVertexAt(uint32_t s) const {
    Int3 at = *sides_[s].place;
    const ChunkGrid& grid = patch_.grid();
    for (int k = 0; k < 3; ++k) {
      at[k] += static_cast<int32_t>((int64_t{sides_[s].corner[k]} - grid.origin[k]) / grid.cell) * kSubcell;
    }
    return at;
  }

  const SurfacePatch& patch_;
  std::span<const SharpSide> sides_;
};

/// The place of a loop of the patch among the sharp ones; kNoSide if it is not sharp.
uint32_t findSharp(std::span<const SharpLoop> loops, uint32_t number) {
  const auto at = std::lower_bound(loops.begin(), loops.end(), number,
                                   [](const SharpLoop& loop, uint32_t n) { return loop.loop < n; });
  return at != loops.end() && at->loop == number ? static_cast<uint32_t>(at - loops.begin()) : kNoSide;
}

/// The loops near each other: whose triangles may meet. A fan may reach less than a cell beyond its own, and so two of
/// them may meet if their cells are two apart, but only if one reaches farther than half a cell.
class Neighbours {
 public:
  Neighbours(const SurfacePatch& patch, std::span<const SharpSide> sides, std::span<const SharpLoop> loops,
             std::pmr::memory_resource* memory)
      : patch_(patch), far_(memory) {
    for (const SharpLoop& loop : loops)
      if (loop.centre && reachesFar(loop, sides)) far_.push_back(loop.loop);
  }

  /// Calls visit(number) for all loops that may meet a loop, but for the loop itself.
  template <class Visit>
  void visit(uint32_t loop, const Visit& visit) const {
    const Int3 cell = patch_.loops()[loop].cell;
    const bool is_far = std::binary_search(far_.begin(), far_.end(), loop);
    const int32_t reach = is_far ? 2 : 1;
    for (int32_t z = -reach; z <= reach; ++z)
      for (int32_t y = -reach; y <= reach; ++y)
        for (int32_t x = -reach; x <= reach; ++x)
          for (const uint32_t other : patch_.loopsOf({cell.x + x, cell.y + y, cell.z + z}))
            if (other != loop) visit(other);
    if (is_far) return;
    for (const uint32_t other : far_) {
      const Int3& at = patch_.loops()[other].cell;
      if (std::max({std::abs(at.x - cell.x), std::abs(at.y - cell.y), std::abs(at.z - cell.z)}) == 2) visit(other);
    }
  }

 private:
  bool reachesFar(const SharpLoop& loop, std::span<const SharpSide> sides) const {
    const auto isFar = [](const Int3& place) {
      return std::min({place.x, place.y, place.z}) < -kSubcell / 2 + 1 ||
             std::max({place.x, place.y, place.z}) > kSubcell + kSubcell / 2 - 1;
    };
    const Int3 corner = patch_.cornerOf(patch_.loops()[loop.loop].cell);
    const auto isFarSpare = [&](const std::optional<Int3>& spare) { return spare && isFar(*spare); };
    return isFar(*loop.centre) || isFarSpare(loop.spares[0]) || isFarSpare(loop.spares[1]) ||
           std::any_of(loop.sides.begin(), loop.sides.end(), [&](uint32_t s) {
             if (s == kNoSide || !sides[s].place) return false;
             Int3 place = *sides[s].place;
             for (int k = 0; k < 3; ++k) place[k] += (sides[s].corner[k] - corner[k]) / patch_.grid().cell * kSubcell;
             return isFar(place);
           });
  }

  const SurfacePatch& patch_;
  std::pmr::vector<uint32_t> far_;  ///< numbers of the loops whose fans reach farther than half a cell, ascending
};

constexpr auto kAllVertices = [](const SharpSide&) { return 1u; };
constexpr auto kEitherWay = [](const SharpSide&) { return 3u; };

/// Whether a triangle has no area or two meet wrongly, of those that one fan can have at one time.
bool hasFault(const Triangles& fan) {
  const std::span<const Possible> all = fan.all();
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
  PresentTriangles(const SurfacePatch& patch, std::span<const SharpSide> sides, std::span<const SharpLoop> loops,
                   std::pmr::memory_resource* memory)
      : maker_(patch, sides), sides_(sides), loops_(loops), store_(memory), of_loop_(patch.loops().size(), memory) {}

  /// Good until the next call of forget().
  const Triangles& of(uint32_t number) {
    std::optional<Triangles>& triangles = of_loop_[number];
    if (triangles) return *triangles;
    triangles.emplace(store_);
    const uint32_t place = findSharp(loops_, number);
    if (place != kNoSide && isFan(loops_[place])) {
      maker_.addFan(
          loops_[place], [&](const SharpSide& side) { return hasVertex(side) ? 1u : 2u; }, *triangles);
    } else {
      maker_.addPlain(number, *triangles);
    }
    return *triangles;
  }
  /// After a change of the loop.
  void forget(const SharpLoop& loop) {
    of_loop_[loop.loop].reset();
    for (const uint32_t s : loop.sides) {
      if (s == kNoSide) continue;
      for (const uint32_t other : sides_[s].loops)
        if (other != kNoSide) of_loop_[loops_[other].loop].reset();
    }
  }

  static bool isFan(const SharpLoop& loop) { return loop.centre && !loop.rounded; }

 private:
  bool hasVertex(const SharpSide& side) const {
    return std::all_of(side.loops.begin(), side.loops.end(),
                       [&](uint32_t loop) { return loop == kNoSide || isFan(loops_[loop]); });
  }

  const TriangleMaker maker_;
  std::span<const SharpSide> sides_;
  std::span<const SharpLoop> loops_;
  std::pmr::vector<Possible> store_;
  std::pmr::vector<std::optional<Triangles>> of_loop_;
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
  const auto meetsPlain = [&](const Triangles& fan, uint32_t number, const SharpLoop* other) {
    Triangles plain(store);
    maker.addPlain(number, plain);
    if (!fan.box.meets(plain.box)) return false;
    for (const Possible& a : fan.all())
      for (const Possible& b : plain.all())
        if ((other == nullptr || hasPlain(*other, a)) && a.meets(b)) return true;
    return false;
  };
  const auto meetsFan = [&](const Triangles& fan, const SharpLoop& other) {
    Triangles second(store);
    maker.addFan(other, kEitherWay, second);
    if (!fan.box.meets(second.box)) return false;
    for (const Possible& a : fan.all())
      for (const Possible& b : second.all())
        if ((a.side == kNoSide || a.side != b.side || a.when == b.when) && a.meets(b)) return true;
    return false;
  };
  for (const uint32_t number : numbers) {
    const uint32_t place = findSharp(loops_, number);
    if (place == kNoSide || !loops_[place].centre) continue;
    SharpLoop& own = loops_[place];
    store.clear();
    // Triangles point into the store, which others are appended to.
    Triangles fan(store);
    maker.addFan(own, kEitherWay, fan);
    own.rounded = own.rounded || hasFault(fan);
    neighbours.visit(number, [&](uint32_t other_number) {
      if (own.rounded) return;
      const uint32_t other_place = findSharp(loops_, other_number);
      const SharpLoop* other = other_place == kNoSide ? nullptr : &loops_[other_place];
      own.rounded = meetsPlain(fan, other_number, other);
      if (other == nullptr || !other->centre) return;
      // Within a chunk a loop may come to have a spare centre.
      SharpLoop state = *other;
      for (const std::optional<Int3>& centre : {other->centre, other->spares[0], other->spares[1]}) {
        if (own.rounded || !centre) return;
        state.centre = centre;
        own.rounded = meetsFan(fan, state);
      }
    });
  }
}

void FanConflicts::roundUntilValid(std::span<const uint32_t> numbers) {
  const Neighbours neighbours(patch_, sides_, loops_, memory_);
  PresentTriangles present(patch_, sides_, loops_, memory_);
  std::pmr::vector<uint32_t> dirty(numbers.begin(), numbers.end(), memory_), changed(memory_);
  while (!dirty.empty()) {
    changed.clear();
    for (const uint32_t number : dirty) {
      const uint32_t place = findSharp(loops_, number);
      if (place == kNoSide || !PresentTriangles::isFan(loops_[place])) continue;
      const Triangles own = present.of(number);
      bool faulty = hasFault(own);
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

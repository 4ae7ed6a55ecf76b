#include "mesh/ambiguous_faces.h"

#include <algorithm>
#include <optional>
#include <span>

#include "mesh/fan_conflicts.h"
#include "mesh/fan_triangles.h"
#include "mesh/loop_triangles.h"
#include "mesh/triangulate_any.h"

namespace sgm {
namespace {

/// Pieces of a diagonal that is looked at.
constexpr int32_t kPieces = 16;
constexpr uint32_t kNone = UINT32_MAX;

/// By the cell on the high side of a face, and the axis that the face stands on.
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
  std::array<Int3, 2> solid;  ///< its solid corners, in units
  bool is_joined = true;      ///< whether the solid is
};

/// The part of a loop in one face of a cell.
struct Side {
  uint32_t from = 0, to = 0;
  uint32_t face = kNone;  ///< number of the ambiguous face, if it may be joined
};

/// The sides of all loops of a cell, and the loops that they make.
struct CellSides {
  std::array<Side, kCubeEdges> all;
  size_t count = 0;

  std::span<Side> sides() { return {all.data(), count}; }
};

struct Loop {
  std::array<LoopPoint, kLongestBodyLoop> points;
  int count = 0;
};

/// The loops of one cell, in the order of their lowest edges.
struct CellLoops {
  std::array<Loop, kCubeEdges / 3> all;
  size_t count = 0;

  std::span<const Loop> loops() const { return {all.data(), count}; }
};

/// Whether a loop has triangles without a diagonal in a face of its cell.
bool canTriangulate(const Loop& loop) {
  const auto n = static_cast<size_t>(loop.count);
  std::array<std::array<bool, kLongestBodyLoop>, kLongestBodyLoop> can{};
  for (size_t i = 0; i + 1 < n; ++i) can[i][i + 1] = true;
  for (size_t span = 2; span < n; ++span) {
    for (size_t i = 0; i + span < n; ++i) {
      const size_t j = i + span;
      if (span != n - 1 && (loop.points[i].faces & loop.points[j].faces) != 0) continue;
      for (size_t k = i + 1; k < j; ++k) can[i][j] = can[i][j] || (can[i][k] && can[k][j]);
    }
  }
  return can[0][n - 1];
}

class Joiner {
 public:
  Joiner(const BodyLoops& body, const Creases& creases, std::span<const SharpSide> border,
         std::pmr::memory_resource* memory)
      : loops_(body), body_(body.part()), creases_(creases), border_(border), faces_(memory), memory_(memory) {}

  std::optional<RawVector<uint32_t>> join(const FieldSampler& field) {
    findFaces();
    if (!faces_.empty()) askField(field);
    giveUpFaulty();
    const auto isJoined = [](const AmbiguousFace& face) { return face.is_joined; };
    if (std::none_of(faces_.begin(), faces_.end(), isJoined)) return std::nullopt;
    return indices();
  }

 private:
  using Triangles = std::array<uint32_t, 3 * (kLongestBodyLoop - 2)>;

  FaceName faceOf(const SurfaceLoop& loop, uint32_t a, uint32_t b) const {
    FaceName name{loop.cell, sharedFace(body_.keys[a], body_.keys[b])};
    // The corner of an edge in the face has the face's height.
    if (body_.keys[a].corner[name.axis] != loops_.cornerOf(loop.cell)[name.axis]) ++name.cell[name.axis];
    return name;
  }
  static bool isAtBorder(const FaceName& face) {
    return face.cell[face.axis] == 0 || face.cell[face.axis] == kChunkCells;
  }
  /// The corner of the grid at which the edges of two vertices meet, if they are not parallel.
  Int3 cornerBetween(uint32_t a, uint32_t b) const {
    const VertexKey &of_a = body_.keys[a], &of_b = body_.keys[b];
    Int3 corner = of_a.corner;
    corner[of_a.axis] = of_b.corner[of_a.axis];
    return corner;
  }

  /// Calls visit(loop, i) for the sides of a loop, which begin at its vertices.
  template <class Visit>
  void visitSides(Int3 lo, Int3 hi, const Visit& visit) const {
    loops_.visitWithin(lo, hi, [&](uint32_t number) {
      const SurfaceLoop& loop = loops_.all()[number];
      for (uint32_t i = 0; i < loop.count; ++i) visit(loop, loop.vertices[i], loop.vertices[(i + 1) % loop.count]);
    });
  }

  /// Ambiguous faces that a crease passes through.
  void findFaces() {
    for (const SurfaceLoop& loop : loops_.all()) {
      for (uint32_t i = 0; i < loop.count; ++i) {
        const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
        if (creases_.isSharp(a, b)) consider(loop, a, b);
      }
    }
    std::sort(faces_.begin(), faces_.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    const auto end = std::unique(faces_.begin(), faces_.end(),
                                 [](const AmbiguousFace& a, const AmbiguousFace& b) { return a.name == b.name; });
    faces_.erase(end, faces_.end());
  }

  /// a, b: a side of the loop with a crease.
  void consider(const SurfaceLoop& loop, uint32_t a, uint32_t b) {
    const FaceName name = faceOf(loop, a, b);
    if (isAtBorder(name)) return;
    std::optional<Int3> other;
    visitSides(loop.cell, loop.cell, [&](const SurfaceLoop& beside, uint32_t c, uint32_t d) {
      if (c != a && sharedFace(body_.keys[c], body_.keys[d]) == name.axis && faceOf(beside, c, d) == name)
        other = cornerBetween(c, d);
    });
    if (other) faces_.push_back({name, {cornerBetween(a, b), *other}});
  }

  /// Leaves the faces whose solid corners are joined by a straight line in the solid.
  void askField(const FieldSampler& field) {
    std::pmr::vector<Int3> points(memory_);
    points.reserve(faces_.size() * (kPieces - 1));
    for (const AmbiguousFace& face : faces_) {
      for (int32_t i = 1; i < kPieces; ++i) {
        Int3 point;
        for (int k = 0; k < 3; ++k) {
          const int64_t way = int64_t{face.solid[1][k]} - face.solid[0][k];
          point[k] = static_cast<int32_t>(face.solid[0][k] + floorDiv(way * i, int64_t{kPieces}));
        }
        points.push_back(point);
      }
    }
    std::pmr::vector<FieldSample> samples(points.size(), memory_);
    field(points, samples, Sampled::value);
    size_t kept = 0;
    for (size_t i = 0; i < faces_.size(); ++i) {
      const std::span<const FieldSample> own(samples.data() + i * (kPieces - 1), kPieces - 1);
      if (std::all_of(own.begin(), own.end(), [](const FieldSample& sample) { return sample.q < 0; }))
        faces_[kept++] = faces_[i];
    }
    faces_.resize(kept);
  }

  uint32_t numberOf(const FaceName& name) const {
    const auto at = std::lower_bound(faces_.begin(), faces_.end(), name,
                                     [](const AmbiguousFace& face, const FaceName& n) { return face.name < n; });
    return at != faces_.end() && at->name == name ? static_cast<uint32_t>(at - faces_.begin()) : kNone;
  }

  /// The sides of a cell, with the joined faces joined.
  CellSides sidesOf(const Int3& cell) const {
    CellSides of_cell;
    visitSides(cell, cell, [&](const SurfaceLoop& loop, uint32_t a, uint32_t b) {
      const uint32_t face = numberOf(faceOf(loop, a, b));
      of_cell.all[of_cell.count++] = {a, b, face != kNone && faces_[face].is_joined ? face : kNone};
    });
    for (Side& side : of_cell.sides()) {
      for (Side& other : of_cell.sides()) {
        if (&other <= &side || side.face == kNone || other.face != side.face) continue;
        std::swap(side.to, other.to);
      }
    }
    return of_cell;
  }

  CellLoops loopsOf(const Int3& cell) const {
    const Int3 corner = loops_.cornerOf(cell);
    std::array<uint32_t, kCubeEdges> vertex, next;
    next.fill(kNone);
    CellSides of_sides = sidesOf(cell);
    for (const Side& side : of_sides.sides()) {
      const uint32_t from = cubeEdge(body_.keys[side.from], corner);
      vertex[from] = side.from;
      next[from] = cubeEdge(body_.keys[side.to], corner);
    }
    CellLoops of_cell;
    for (uint32_t start = 0; start < kCubeEdges; ++start) {
      if (next[start] == kNone) continue;
      Loop& loop = of_cell.all[of_cell.count++];
      for (uint32_t edge = start; next[edge] != kNone;) {
        const Int3 at = placeOf(body_, vertex[edge]);
        loop.points[static_cast<size_t>(loop.count++)] = {at.x, at.y, at.z, kCubeEdgeFaces[edge], vertex[edge]};
        edge = std::exchange(next[edge], kNone);
      }
    }
    return of_cell;
  }

  static std::span<const uint32_t> triangulated(const Loop& loop, Triangles& triangles) {
    uint32_t* const end = triangulateAnyLoop<kLongestBodyLoop>(loop.points.data(), loop.count, triangles.data());
    return {triangles.data(), end};
  }

  bool isJoined(const FaceName& name) const {
    const uint32_t face = numberOf(name);
    return face != kNone && faces_[face].is_joined;
  }
  bool isJoinedAt(const Int3& cell) const {
    const std::array<FaceName, 6> names = FaceName::of(cell);
    return std::any_of(names.begin(), names.end(), [this](const FaceName& name) { return isJoined(name); });
  }

  const SharpSide* borderSide(uint32_t a, uint32_t b) const {
    if (border_.empty()) return nullptr;
    const SharpSide side = sideBetween(a, b, body_.keys);
    const auto at = std::lower_bound(border_.begin(), border_.end(), side);
    return at != border_.end() && !(side < *at) && !at->places.empty() ? &*at : nullptr;
  }

  /// The triangles of a loop that is rounded (mesh/sharp_loops.h): its own, or a fan with its border's face vertices.
  LoopTriangles roundedTriangles(const Int3& cell, const Loop& loop) const {
    std::array<FanPoint, kLongestBodyLoop*(1 + FacePlaces::kMost)> ring;
    std::array<BorderVertex, kLongestBodyLoop * FacePlaces::kMost> at_border;
    std::array<Int3, kLongestBodyLoop> vertices;
    size_t count = 0, border_count = 0;
    const auto n = static_cast<size_t>(loop.count);
    for (size_t i = 0; i < n; ++i) {
      const uint32_t a = loop.points[i].vertex, b = loop.points[(i + 1) % n].vertex;
      vertices[i] = placeOf(body_, a);
      ring[count++] = {vertices[i], a};
      const SharpSide* const side = borderSide(a, b);
      if (side == nullptr) continue;
      for (size_t k = 0; k < side->places.count(); ++k) {
        const size_t which = a == side->from ? k : side->places.count() - 1 - k;
        const Int3 at = fromChunk(loops_.grid(), *side, side->places.all()[which]);
        const auto number = static_cast<uint32_t>(side - border_.data());
        ring[count++] = {at, kFaceVertices + SharpLoops::faceVertexOf(number, which), true};
        at_border[border_count++] = {at, side->axis};
      }
    }
    if (border_count > 0) {
      const Int3 centre = roundedCentre(cell, {vertices.data(), n}, {at_border.data(), border_count});
      return coneTriangles({centre, kCellVertices + ring[0].name, true}, {ring.data(), count}, true);
    }
    Triangles triangles;
    LoopTriangles made;
    const std::span<const uint32_t> v = triangulated(loop, triangles);
    for (size_t at = 0; at < v.size(); at += 3)
      made.add({placeOf(body_, v[at]), placeOf(body_, v[at + 1]), placeOf(body_, v[at + 2])},
               {v[at], v[at + 1], v[at + 2]});
    return made;
  }

  bool hasBorderVertices(const CellLoops& of_cell) const {
    const auto has = [this](const Loop& loop) {
      const auto n = static_cast<size_t>(loop.count);
      for (size_t i = 0; i < n; ++i)
        if (borderSide(loop.points[i].vertex, loop.points[(i + 1) % n].vertex) != nullptr) return true;
      return false;
    };
    return std::any_of(of_cell.loops().begin(), of_cell.loops().end(), has);
  }

  /// Whether the loops of a cell have triangles that meet as they should. As meshed they do.
  bool isSound(const Int3& cell) const {
    if (!isJoinedAt(cell)) return true;
    const CellLoops of_cell = loopsOf(cell);
    std::array<LoopTriangles, kCubeEdges / 3> made;
    for (size_t i = 0; i < of_cell.count; ++i) {
      if (!canTriangulate(of_cell.all[i])) return false;
      made[i] = roundedTriangles(cell, of_cell.all[i]);
      if (hasFault(made[i])) return false;
      for (size_t other = 0; other < i; ++other)
        if (anyMeets(made[i], made[other])) return false;
    }
    return isClearOfBeside(cell, of_cell, made);
  }

  /// Whether loops keep clear of those in the cells around theirs, where these or those have face vertices, which may
  /// lie beyond their cell. Others stay in their cells.
  bool isClearOfBeside(const Int3& cell, const CellLoops& of_cell, std::span<const LoopTriangles> made) const {
    if (border_.empty()) return true;
    const bool has_own = hasBorderVertices(of_cell);
    for (int32_t z = cell.z - 1; z <= cell.z + 1; ++z) {
      for (int32_t y = cell.y - 1; y <= cell.y + 1; ++y) {
        for (int32_t x = cell.x - 1; x <= cell.x + 1; ++x) {
          const Int3 beside{x, y, z};
          if (beside == cell) continue;
          const CellLoops others = loopsOf(beside);
          if (!has_own && !hasBorderVertices(others)) continue;
          for (const Loop& other : others.loops()) {
            const LoopTriangles theirs = canTriangulate(other) ? roundedTriangles(beside, other) : LoopTriangles();
            for (size_t i = 0; i < of_cell.count; ++i)
              if (anyMeets(made[i], theirs)) return false;
          }
        }
      }
    }
    return true;
  }

  /// Leaves faces as they are meshed, one by one, until the loops of all cells are sound.
  void giveUpFaulty() {
    for (bool changed = true; changed;) {
      changed = false;
      for (const AmbiguousFace& face : faces_) {
        for (const Int3& cell : face.name.cells()) {
          while (!isSound(cell)) {
            giveUpOne(cell);
            changed = true;
          }
        }
      }
    }
  }

  /// One that makes the cell sound, if there is such.
  void giveUpOne(const Int3& cell) {
    uint32_t first = kNone;
    for (const FaceName& name : FaceName::of(cell)) {
      if (!isJoined(name)) continue;
      const uint32_t face = numberOf(name);
      faces_[face].is_joined = false;
      if (isSound(cell)) return;
      faces_[face].is_joined = true;
      if (first == kNone) first = face;
    }
    faces_[first].is_joined = false;
  }

  RawVector<uint32_t> indices() const {
    RawVector<uint32_t> indices(memory_);
    indices.reserve(body_.indices.size() + 12 * faces_.size());
    const std::pmr::vector<SurfaceLoop>& all = loops_.all();
    for (size_t i = 0; i < all.size(); ++i) {
      if (!isJoinedAt(all[i].cell)) {
        indices.insert(indices.end(), body_.indices.begin() + all[i].first_index,
                       body_.indices.begin() + all[i].end_index);
        continue;
      }
      while (i + 1 < all.size() && all[i + 1].cell == all[i].cell) ++i;
      const CellLoops of_cell = loopsOf(all[i].cell);
      for (const Loop& loop : of_cell.loops()) {
        Triangles triangles;
        const std::span<const uint32_t> v = triangulated(loop, triangles);
        indices.insert(indices.end(), v.begin(), v.end());
      }
    }
    return indices;
  }

  const BodyLoops& loops_;
  const MeshPart& body_;
  const Creases& creases_;
  const std::span<const SharpSide> border_;
  std::pmr::vector<AmbiguousFace> faces_;  ///< by name
  std::pmr::memory_resource* memory_;
};

}  // namespace

std::optional<RawVector<uint32_t>> resolveAmbiguousFaces(const BodyLoops& body, const Creases& creases,
                                                         std::span<const SharpSide> border, const FieldSampler& field,
                                                         std::pmr::memory_resource* memory) {
  return Joiner(body, creases, border, memory).join(field);
}

}  // namespace sgm

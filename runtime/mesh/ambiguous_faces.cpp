#include "mesh/ambiguous_faces.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>

#include "mesh/fan_conflicts.h"
#include "mesh/fan_triangles.h"
#include "mesh/joined_loops.h"
#include "mesh/loop_triangles.h"

namespace sgm {
namespace {

/// The number of equal pieces into which the diagonal of a cell face is divided. The field is sampled at the points
/// between the pieces.
constexpr int32_t kPieces = 16;

class Joiner {
 public:
  Joiner(const BodyLoops& body, const Creases& creases, std::span<const SharpSide> border,
         std::pmr::memory_resource* memory)
      : loops_(body, memory),
        body_(body.part()),
        creases_(creases),
        border_(border),
        border_cells_(memory),
        memory_(memory) {}

  std::optional<RawVector<uint32_t>> join(const FieldSampler& field) {
    loops_.setFaces(joinedByField(ambiguousFaces(), field));
    if (loops_.faces().empty()) return std::nullopt;
    if (!border_.empty()) findBorderCells();
    giveUpFaulty();
    const auto isJoined = [](const AmbiguousFace& face) { return face.is_joined; };
    if (std::none_of(loops_.faces().begin(), loops_.faces().end(), isJoined)) return std::nullopt;
    return indices();
  }

 private:
  static bool isInBorder(const FaceName& face) {
    return face.cell[face.axis] == 0 || face.cell[face.axis] == kChunkCells;
  }
  /// Returns the grid corner at which the edge of vertex a meets the edge of vertex b. Precondition: the two edges are
  /// not parallel.
  Int3 cornerBetween(uint32_t a, uint32_t b) const {
    const VertexKey &of_a = body_.keys[a], &of_b = body_.keys[b];
    Int3 corner = of_a.corner;
    corner[of_a.axis] = of_b.corner[of_a.axis];
    return corner;
  }

  /// Returns those ambiguous faces inside the chunk that a crease passes through, sorted by FaceName.
  std::pmr::vector<AmbiguousFace> ambiguousFaces() const {
    std::pmr::vector<AmbiguousFace> faces(memory_);
    for (const SurfaceLoop& loop : loops_.body().all()) {
      for (uint32_t i = 0; i < loop.count; ++i) {
        const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
        if (!creases_.isSharp(a, b)) continue;
        if (const std::optional<AmbiguousFace> face = ambiguousFace(loop, a, b)) faces.push_back(*face);
      }
    }
    std::sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    const auto end = std::unique(faces.begin(), faces.end(),
                                 [](const AmbiguousFace& a, const AmbiguousFace& b) { return a.name == b.name; });
    faces.erase(end, faces.end());
    return faces;
  }

  /// Returns the cell face that contains the loop side from vertex a to vertex b, if this face is ambiguous: a second
  /// loop side lies in it, of this loop or of another loop of the cell. Returns nullopt if the face is not ambiguous,
  /// or if it lies in a face of the chunk.
  std::optional<AmbiguousFace> ambiguousFace(const SurfaceLoop& loop, uint32_t a, uint32_t b) const {
    const FaceName name = loops_.faceOf(loop, a, b);
    if (isInBorder(name)) return std::nullopt;
    std::optional<AmbiguousFace> face;
    loops_.visitSides(loop.cell, [&](const SurfaceLoop& beside, uint32_t c, uint32_t d) {
      if (c == a || sharedFace(body_.keys[c], body_.keys[d]) != name.axis || loops_.faceOf(beside, c, d) != name)
        return;
      face = AmbiguousFace{name, {cornerBetween(a, b), cornerBetween(c, d)}};
      // The two solid corners are sorted, so that their order does not depend on the loop side or cell from which the
      // face was found.
      if (isBefore(face->solid[1], face->solid[0])) std::swap(face->solid[0], face->solid[1]);
    });
    return face;
  }

  /// Returns the ambiguous faces whose two solid corners the field joins: all samples on the diagonal between these
  /// corners are solid.
  std::pmr::vector<AmbiguousFace> joinedByField(std::pmr::vector<AmbiguousFace>&& faces,
                                                const FieldSampler& field) const {
    std::pmr::vector<Int3> points(memory_);
    points.reserve(faces.size() * (kPieces - 1));
    for (const AmbiguousFace& face : faces) {
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
    if (!points.empty()) field(points, samples, Sampled::value);
    size_t kept = 0;
    for (size_t i = 0; i < faces.size(); ++i) {
      const std::span<const FieldSample> own(samples.data() + i * (kPieces - 1), kPieces - 1);
      if (std::all_of(own.begin(), own.end(), [](const FieldSample& sample) { return sample.q < 0; }))
        faces[kept++] = faces[i];
    }
    faces.resize(kept);
    return std::move(faces);
  }

  const SharpSide* borderSide(uint32_t a, uint32_t b) const {
    if (border_.empty()) return nullptr;
    const SharpSide side = sideBetween(a, b, body_.keys);
    const auto at = std::lower_bound(border_.begin(), border_.end(), side);
    return at != border_.end() && !(side < *at) && !at->places.empty() ? &*at : nullptr;
  }

  /// Returns the triangles of a loop without sharp features inside the chunk (a "rounded" loop, mesh/sharp_loops.h). If
  /// the loop has face vertices in a face of the chunk, its triangles are a fan. Otherwise, they are the triangles of
  /// marching cubes.
  LoopTriangles roundedTriangles(const Int3& cell, const CellLoop& loop) const {
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
        const Int3 at = fromChunk(loops_.body().grid(), *side, side->places.all()[which]);
        const auto number = static_cast<uint32_t>(side - border_.data());
        ring[count++] = {at, kFaceVertices + SharpLoops::faceVertexOf(number, which), true};
        at_border[border_count++] = {at, side->axis};
      }
    }
    if (border_count > 0) {
      const Int3 centre = roundedCentre(cell, {vertices.data(), n}, {at_border.data(), border_count});
      return coneTriangles({centre, kCellVertices + ring[0].name, true}, {ring.data(), count}, true);
    }
    CellLoop::Triangles triangles;
    LoopTriangles made;
    const std::span<const uint32_t> v = loop.triangulated(triangles);
    for (size_t at = 0; at < v.size(); at += 3)
      made.add({placeOf(body_, v[at]), placeOf(body_, v[at + 1]), placeOf(body_, v[at + 2])},
               {v[at], v[at + 1], v[at + 2]});
    return made;
  }

  /// Finds the cells with a loop that has face vertices (mesh/sharp_loops.h) in a face of the chunk.
  void findBorderCells() {
    for (const SurfaceLoop& loop : loops_.body().all()) {
      if (!isAtBorder(loop.cell)) continue;
      for (uint32_t i = 0; i < loop.count; ++i) {
        if (borderSide(loop.vertices[i], loop.vertices[(i + 1) % loop.count]) == nullptr) continue;
        border_cells_.push_back(loop.cell);
        break;
      }
    }
    std::sort(border_cells_.begin(), border_cells_.end(), isBefore);
  }
  static bool isBefore(const Int3& a, const Int3& b) { return std::array{a.z, a.y, a.x} < std::array{b.z, b.y, b.x}; }
  static bool isAtBorder(const Int3& cell) {
    return std::min({cell.x, cell.y, cell.z}) == 0 || std::max({cell.x, cell.y, cell.z}) == kChunkCells - 1;
  }
  /// True if a cell, or a cell adjacent to it, may touch a face of the chunk.
  static bool isNearBorder(const Int3& cell) {
    return std::min({cell.x, cell.y, cell.z}) <= 1 || std::max({cell.x, cell.y, cell.z}) >= kChunkCells - 2;
  }
  bool hasBorderVertices(const Int3& cell) const {
    return isAtBorder(cell) && std::binary_search(border_cells_.begin(), border_cells_.end(), cell, isBefore);
  }
  /// Calls visit for all other cells of the chunk that are at most two cells away from `cell` on each axis.
  template <class Visit>
  static void visitAround(const Int3& cell, const Visit& visit) {
    for (int32_t z = std::max(cell.z - 2, 0); z <= std::min(cell.z + 2, kChunkCells - 1); ++z)
      for (int32_t y = std::max(cell.y - 2, 0); y <= std::min(cell.y + 2, kChunkCells - 1); ++y)
        for (int32_t x = std::max(cell.x - 2, 0); x <= std::min(cell.x + 2, kChunkCells - 1); ++x)
          if (const Int3 other{x, y, z}; !(other == cell)) visit(other);
  }

  /// True if the triangles of the cell's loops intersect neither each other nor triangles of the cells around it. A
  /// cell without joined ambiguous faces needs no test: its loops are those of marching cubes, which never intersect.
  bool isSound(const Int3& cell) const {
    if (!loops_.isJoinedAt(cell)) return true;
    const CellLoops of_cell = loops_.loopsOf(cell);
    std::array<LoopTriangles, kCubeEdges / 3> made;
    for (size_t i = 0; i < of_cell.count; ++i) {
      if (!of_cell.all[i].canTriangulate()) return false;
      made[i] = roundedTriangles(cell, of_cell.all[i]);
      if (hasFault(made[i])) return false;
      for (size_t other = 0; other < i; ++other)
        if (anyMeets(made[i], made[other])) return false;
    }
    return isClearOfOthers(cell, of_cell, made);
  }

  /// True if the loops of a cell do not intersect the loops of the cells around it. Only a loop with face vertices in a
  /// face of the chunk can reach out of its cell, because these vertices may lie in the adjacent cell. So this function
  /// compares two adjacent cells only if one of them has such a loop, and two cells at a distance of two only if both
  /// have one.
  bool isClearOfOthers(const Int3& cell, const CellLoops& of_cell, std::span<const LoopTriangles> made) const {
    if (border_cells_.empty() || !isNearBorder(cell)) return true;
    const bool has_own = hasBorderVertices(cell);
    bool is_clear = true;
    visitAround(cell, [&](const Int3& other) {
      const Int3 way{other.x - cell.x, other.y - cell.y, other.z - cell.z};
      const bool is_beside = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)}) == 1;
      const bool has_others = hasBorderVertices(other);
      if (!is_clear || !(is_beside ? has_own || has_others : has_own && has_others)) return;
      const CellLoops others = loops_.loopsOf(other);
      for (const CellLoop& loop : others.loops()) {
        // Skips a loop that has no valid triangulation: isSound() finds that fault when it tests the loop's own cell.
        if (!loop.canTriangulate()) continue;
        const LoopTriangles theirs = roundedTriangles(other, loop);
        for (size_t i = 0; i < of_cell.count; ++i) is_clear = is_clear && !anyMeets(made[i], theirs);
      }
    });
    return is_clear;
  }

  /// Makes isSound() true for all cells: while it is false for some cell, separates the solid corners of one more
  /// joined face.
  void giveUpFaulty() {
    std::pmr::vector<Int3> left(memory_);  // stack of the cells to be tested
    const std::span<const AmbiguousFace> faces = loops_.faces();
    for (auto face = faces.rbegin(); face != faces.rend(); ++face)
      for (const Int3& cell : face->name.cells()) left.push_back(cell);
    while (!left.empty()) {
      const Int3 cell = left.back();
      left.pop_back();
      while (!isSound(cell)) {
        for (const Int3& changed : giveUpOne(cell).cells())
          visitDependent(changed, [&](const Int3& dependent) { left.push_back(dependent); });
      }
    }
  }

  /// Calls visit for the cell and for all other cells whose isSound() depends on its loops.
  template <class Visit>
  void visitDependent(const Int3& cell, const Visit& visit) const {
    visit(cell);
    if (border_cells_.empty() || !isNearBorder(cell)) return;
    visitAround(cell, [&](const Int3& other) {
      if (loops_.isJoinedAt(other)) visit(other);
    });
  }

  /// Separates one of the cell's joined ambiguous faces again, and returns the name of this face. Chooses the first
  /// joined face for which isSound(cell) becomes true; if there is none, the first joined face.
  FaceName giveUpOne(const Int3& cell) {
    std::optional<FaceName> first;
    for (const FaceName& name : FaceName::of(cell)) {
      if (!loops_.isJoined(name)) continue;
      loops_.setJoined(name, false);
      if (isSound(cell)) return name;
      loops_.setJoined(name, true);
      if (!first) first = name;
    }
    loops_.setJoined(*first, false);
    return *first;
  }

  RawVector<uint32_t> indices() const {
    RawVector<uint32_t> indices(memory_);
    indices.reserve(body_.indices.size() + 12 * loops_.faces().size());
    const std::pmr::vector<SurfaceLoop>& all = loops_.body().all();
    for (size_t i = 0; i < all.size(); ++i) {
      if (!loops_.isJoinedAt(all[i].cell)) {
        indices.insert(indices.end(), body_.indices.begin() + all[i].first_index,
                       body_.indices.begin() + all[i].end_index);
        continue;
      }
      while (i + 1 < all.size() && all[i + 1].cell == all[i].cell) ++i;
      const CellLoops of_cell = loops_.loopsOf(all[i].cell);
      for (const CellLoop& loop : of_cell.loops()) {
        CellLoop::Triangles triangles;
        const std::span<const uint32_t> v = loop.triangulated(triangles);
        indices.insert(indices.end(), v.begin(), v.end());
      }
    }
    return indices;
  }

  JoinedLoops loops_;
  const MeshPart& body_;
  const Creases& creases_;
  const std::span<const SharpSide> border_;
  std::pmr::vector<Int3> border_cells_;  ///< sorted
  std::pmr::memory_resource* memory_;
};

}  // namespace

std::optional<RawVector<uint32_t>> resolveAmbiguousFaces(const BodyLoops& body, const Creases& creases,
                                                         std::span<const SharpSide> border, const FieldSampler& field,
                                                         std::pmr::memory_resource* memory) {
  return Joiner(body, creases, border, memory).join(field);
}

}  // namespace sgm

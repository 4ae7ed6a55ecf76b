#include "mesh/sharpen.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "mesh/ambiguous_faces.h"
#include "mesh/border_vertices.h"
#include "mesh/creases.h"
#include "mesh/feature_kind.h"
#include "mesh/features.h"
#include "mesh/hash.h"

namespace sgm {
namespace {

uint32_t append(const ChunkGrid& grid, const VertexKey& key, const Int3& place, const Vertex& like, MeshPart& part) {
  Vertex vertex = like;
  const auto at = [&](int axis) {
    return static_cast<int16_t>(
        static_cast<int32_t>((int64_t{key.corner[axis]} - grid.origin[axis]) / grid.cell) * kSubcell + place[axis]);
  };
  vertex.x = at(0);
  vertex.y = at(1);
  vertex.z = at(2);
  vertex.kind = featureKind(key, place, grid.level);
  part.vertices.push_back(vertex);
  part.keys.push_back(key);
  return static_cast<uint32_t>(part.vertices.size() - 1);
}

/// Returns the lowest cube edge (by number) that the loop passes through; it identifies the loop within its cell.
uint8_t lowestEdge(const SurfaceLoop& loop, const Int3& corner, const RawVector<VertexKey>& keys) {
  uint8_t lowest = UINT8_MAX;
  for (uint32_t i = 0; i < loop.count; ++i) lowest = std::min(lowest, cubeEdge(keys[loop.vertices[i]], corner));
  return lowest;
}

/// Writes the feature vertices and new triangles of all sharp loops into the mesh body.
class BodyWriter {
 public:
  BodyWriter(const SharpLoops& sharp, MeshPart& body, std::pmr::memory_resource* memory)
      : sharp_(sharp), body_(body), memory_(memory) {}

  void write() {
    constexpr uint32_t kNone = SharpLoops::kNone;
    std::pmr::vector<uint32_t> face_vertices(FacePlaces::kMost * sharp_.sides.size(), kNone, memory_);
    for (uint32_t s = 0; s < sharp_.sides.size(); ++s) {
      const SharpSide& side = sharp_.sides[s];
      if (!sharp_.hasFaceVertices(side)) continue;
      for (size_t k = 0; k < side.places.count(); ++k)
        face_vertices[SharpLoops::faceVertexOf(s, k)] = addFaceVertex(side, k);
    }
    RawVector<uint32_t> indices(memory_);
    indices.reserve(body_.indices.size() + 15 * sharp_.loops.size());
    size_t copied = 0;
    const auto copyTo = [&](size_t end) {
      indices.insert(indices.end(), body_.indices.begin() + static_cast<std::ptrdiff_t>(copied),
                     body_.indices.begin() + static_cast<std::ptrdiff_t>(end));
    };
    for (const SharpLoop& sharp : sharp_.loops) {
      const std::optional<FanCentre> fan = sharp_.centreOf(sharp);
      if (!fan) continue;
      const SurfaceLoop& loop = sharp_.of(sharp);
      copyTo(loop.first_index);
      copied = loop.end_index;
      const uint32_t centre = fan->kind == FanCentre::Kind::cell_vertex ? addCellVertex(loop, fan->at) : kNone;
      const LoopTriangles triangles = sharp_.trianglesOf(sharp);
      for (const NamedTriangle& triangle : triangles.all()) {
        for (const uint32_t name : triangle.name) {
          indices.push_back(name >= kCellVertices   ? centre
                            : name >= kFaceVertices ? face_vertices[name - kFaceVertices]
                                                    : name);
        }
      }
    }
    copyTo(body_.indices.size());
    body_.indices = std::move(indices);
  }

 private:
  uint32_t addFaceVertex(const SharpSide& side, size_t which) {
    return append(sharp_.body.grid(), faceVertexKey(side, sharp_.body.part().keys[side.from], which),
                  side.places.all()[which], body_.vertices[side.from], body_);
  }
  uint32_t addCellVertex(const SurfaceLoop& loop, const Int3& from_chunk) {
    const Int3 corner = sharp_.body.cornerOf(loop.cell);
    const uint8_t fan = lowestEdge(loop, corner, sharp_.body.part().keys);
    Int3 place = from_chunk;
    for (int k = 0; k < 3; ++k) place[k] -= loop.cell[k] * kSubcell;
    return append(sharp_.body.grid(), {corner, static_cast<uint8_t>(sharp_.body.grid().level), kCellVertex, fan}, place,
                  body_.vertices[loop.vertices[0]], body_);
  }

  const SharpLoops& sharp_;
  MeshPart& body_;
  std::pmr::memory_resource* memory_;
};

}  // namespace

uint32_t sharpenBody(const ChunkGrid& grid, const FieldSampler& field, MeshPart& body,
                     std::pmr::memory_resource* memory) {
  if (body.indices.empty()) return 0;
  Creases creases(grid, field, body, memory);
  creases.settle();
  std::optional<BodyLoops> loops(std::in_place, grid, body, memory);
  const std::pmr::vector<SharpSide> border = borderSides(*loops, creases, field, memory);
  if (std::optional<RawVector<uint32_t>> indices = resolveAmbiguousFaces(*loops, creases, border, field, memory)) {
    body.indices = std::move(*indices);
    loops.emplace(grid, body, memory);
  }
  const SharpLoops sharp = Features(*loops, creases, border, field, memory).find();
  const auto rounded = std::count_if(sharp.loops.begin(), sharp.loops.end(),
                                     [](const SharpLoop& loop) { return loop.shape == SharpLoop::Shape::rounded; });
  BodyWriter(sharp, body, memory).write();
  hashPart(body);
  return static_cast<uint32_t>(rounded);
}

}  // namespace sgm

#include "mesh/sharpen.h"

#include <algorithm>

#include "mesh/feature_kind.h"
#include "mesh/hash.h"

namespace sgm {
namespace {

bool isAtBorder(const Int3& cell) {
  return std::min({cell.x, cell.y, cell.z}) == 0 || std::max({cell.x, cell.y, cell.z}) == kChunkCells - 1;
}

/// The cells beyond the chunk's faces with which a loop shares a sharp side.
template <class Visit>
void visitBeyond(const SurfacePatch& patch, const Features& features, const SurfaceLoop& loop, const Visit& visit) {
  const RawVector<VertexKey>& keys = patch.part().keys;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int32_t step : {-1, 1}) {
      if (loop.cell[axis] != (step < 0 ? 0 : kChunkCells - 1)) continue;
      const int32_t plane = patch.cornerOf(loop.cell)[axis] + (step < 0 ? 0 : patch.grid().cell);
      const auto isInPlane = [&](uint32_t v) { return keys[v].axis != axis && keys[v].corner[axis] == plane; };
      for (uint32_t i = 0; i < loop.count; ++i) {
        const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
        if (!isInPlane(a) || !isInPlane(b) || !features.creases().isSharp(a, b)) continue;
        Int3 beyond = loop.cell;
        beyond[axis] += step;
        visit(beyond);
        break;
      }
    }
  }
}

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

/// The number of a cube's edge by which the loops of a cell are told apart.
uint8_t lowestEdge(const SurfaceLoop& loop, const Int3& corner, const RawVector<VertexKey>& keys) {
  uint8_t lowest = UINT8_MAX;
  for (uint32_t i = 0; i < loop.count; ++i) {
    const VertexKey& key = keys[loop.vertices[i]];
    int edge = 4 * key.axis, bit = 1;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == key.axis) continue;
      edge += key.corner[axis] == corner[axis] ? 0 : bit;
      bit = 2;
    }
    lowest = std::min(lowest, static_cast<uint8_t>(edge));
  }
  return lowest;
}

/// Writes the features of a body's loops into it.
class BodyWriter {
 public:
  BodyWriter(const SurfacePatch& patch, const Features& features, uint32_t own_loops, MeshPart& body,
             std::pmr::memory_resource* memory)
      : patch_(patch), features_(features), own_loops_(own_loops), body_(body), memory_(memory) {}

  void write() {
    const RawVector<Vertex>& settled = patch_.part().vertices;
    std::copy_n(settled.begin(), body_.vertices.size(), body_.vertices.begin());
    std::pmr::vector<uint32_t> face_vertices(features_.sides().size(), Features::kNone, memory_);
    for (size_t s = 0; s < face_vertices.size(); ++s) {
      const SharpSide& side = features_.sides()[s];
      if (isOwn(side) && features_.hasFaceVertex(side)) face_vertices[s] = addFaceVertex(side);
    }
    RawVector<uint32_t> indices(memory_);
    indices.reserve(body_.indices.size() + 15 * features_.loops().size());
    size_t copied = 0;
    const auto copyTo = [&](size_t end) {
      indices.insert(indices.end(), body_.indices.begin() + static_cast<std::ptrdiff_t>(copied),
                     body_.indices.begin() + static_cast<std::ptrdiff_t>(end));
    };
    for (const SharpLoop& sharp : features_.loops()) {
      if (sharp.loop >= own_loops_) break;
      if (!sharp.centre || sharp.rounded) continue;
      const SurfaceLoop& loop = patch_.loops()[sharp.loop];
      std::array<uint32_t, kLongestCubeLoop> middles;
      for (uint32_t i = 0; i < loop.count; ++i) {
        middles[i] = sharp.sides[i] == Features::kNone ? Features::kNone : face_vertices[sharp.sides[i]];
      }
      copyTo(loop.first_index);
      copied = loop.end_index;
      const uint32_t centre = addCellVertex(loop, *sharp.centre);
      for (uint32_t i = 0; i < loop.count; ++i) {
        const uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.count];
        if (middles[i] == Features::kNone) {
          indices.insert(indices.end(), {centre, a, b});
        } else {
          indices.insert(indices.end(), {centre, a, middles[i], centre, middles[i], b});
        }
      }
    }
    copyTo(body_.indices.size());
    body_.indices = std::move(indices);
  }

 private:
  bool isOwn(const SharpSide& side) const {
    return std::any_of(side.loops.begin(), side.loops.end(), [&](uint32_t number) {
      return number != Features::kNone && features_.loops()[number].loop < own_loops_;
    });
  }
  uint32_t addFaceVertex(const SharpSide& side) {
    return append(patch_.grid(), faceVertexKey(side, patch_.part().keys[side.from]), *side.place,
                  body_.vertices[side.from], body_);
  }
  uint32_t addCellVertex(const SurfaceLoop& loop, const Int3& place) {
    const Int3 corner = patch_.cornerOf(loop.cell);
    const uint8_t fan = lowestEdge(loop, corner, patch_.part().keys);
    return append(patch_.grid(), {corner, static_cast<uint8_t>(patch_.grid().level), kCellVertex, fan}, place,
                  body_.vertices[loop.vertices[0]], body_);
  }

  const SurfacePatch& patch_;
  const Features& features_;
  const uint32_t own_loops_;
  MeshPart& body_;
  std::pmr::memory_resource* memory_;
};

}  // namespace

uint32_t sharpenBody(const ChunkGrid& grid, const FieldSampler& field, MeshPart& body,
                     std::pmr::memory_resource* memory) {
  if (body.indices.empty()) return 0;
  SurfacePatch patch(grid, field, memory);
  patch.addBody(body);
  const auto own_loops = static_cast<uint32_t>(patch.loops().size());
  Features features(patch, field, memory);
  features.settle();
  std::pmr::vector<uint32_t> inner(memory), border(memory);
  CellSet around(memory);
  std::pmr::vector<Int3> beyond(memory);
  for (uint32_t number = 0; number < own_loops; ++number) {
    const SurfaceLoop& loop = patch.loops()[number];
    if (!features.isSharp(loop)) continue;
    (isAtBorder(loop.cell) ? border : inner).push_back(number);
    if (isAtBorder(loop.cell)) around.addAround(loop.cell, kReach);
    visitBeyond(patch, features, loop, [&](const Int3& cell) {
      beyond.push_back(cell);
      around.addAround(cell, kReach);
    });
  }
  if (!inner.empty() || !border.empty()) {
    patch.addCells(around);
    features.settle();
    for (const Int3& cell : beyond) {
      const std::span<const uint32_t> loops = patch.loopsOf(cell);
      border.insert(border.end(), loops.begin(), loops.end());
    }
    std::sort(border.begin(), border.end());
    border.erase(std::unique(border.begin(), border.end()), border.end());
    features.find(inner, border);
  }
  BodyWriter(patch, features, own_loops, body, memory).write();
  hashPart(body);
  return static_cast<uint32_t>(
      std::count_if(features.loops().begin(), features.loops().end(),
                    [&](const SharpLoop& loop) { return loop.loop < own_loops && loop.rounded; }));
}

}  // namespace sgm

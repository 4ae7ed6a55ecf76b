#include "api/mesh.h"

#include <algorithm>
#include <cstring>

#include "api/barrier.h"
#include "mesh/hash.h"
#include "mesh/vertex.h"

using namespace sgm::api;

static_assert(sizeof(sgm_vertex) == sizeof(sgm::Vertex) &&
              offsetof(sgm_vertex, material) == offsetof(sgm::Vertex, material) &&
              offsetof(sgm_vertex, normal_x) == offsetof(sgm::Vertex, normal_x) &&
              offsetof(sgm_vertex, tag) == offsetof(sgm::Vertex, tag));
static_assert(SGM_CHUNK_CELLS == sgm::kChunkCells && SGM_SUBCELL == sgm::kSubcell &&
              SGM_UNITS_PER_METRE == sgm::kUnitsPerMetre);

namespace {

/// Bounds in units that hold every vertex: each lies within half a unit of its rounded place.
sgm::IntBox boundsOf(const sgm::ChunkGrid& grid, std::span<const sgm_vertex> vertices) {
  if (vertices.empty()) return {{0, 0, 0}, {0, 0, 0}};
  std::array<uint32_t, 3> lo{UINT32_MAX, UINT32_MAX, UINT32_MAX}, hi{};
  for (const sgm_vertex& v : vertices) {
    const std::array<uint32_t, 3> p{v.x, v.y, v.z};
    for (size_t axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], p[axis]);
      hi[axis] = std::max(hi[axis], p[axis]);
    }
  }
  sgm::IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<size_t>(axis);
    const int64_t cell = grid.cell;
    box.lo[axis] = sgm::saturate(grid.origin[axis] + lo[i] * cell / sgm::kSubcell);
    box.hi[axis] = sgm::saturate(grid.origin[axis] + (hi[i] * cell + sgm::kSubcell - 1) / sgm::kSubcell);
  }
  return box;
}

}  // namespace

sgm_mesh::sgm_mesh(sgm_runtime& runtime_in, const MeshSource& source)
    : runtime(runtime_in),
      key(source.key),
      grid(source.grid),
      vertices(&runtime_in.memory),
      indices(&runtime_in.memory),
      anchors(source.anchors.begin(), source.anchors.end(), &runtime_in.memory),
      tags(&runtime_in.memory) {
  size_t vertex_count = 0, index_count = 0;
  std::array<sgm::PlacedPart, 7> placed;
  size_t placed_count = 0;
  for (size_t i = 0; i < source.parts.size(); ++i) {
    const sgm::MeshPart* part = source.parts[i];
    if (part == nullptr) continue;
    ranges[i] = {static_cast<uint32_t>(vertex_count), static_cast<uint32_t>(part->vertices.size()),
                 static_cast<uint32_t>(index_count), static_cast<uint32_t>(part->indices.size()), part->hash.value()};
    vertex_count += part->vertices.size();
    index_count += part->indices.size();
    placed[placed_count++] = {part, grid, static_cast<int>(i)};
  }
  hash = sgm::hashParts(std::span(placed).first(placed_count)).value();
  vertices.allocate(vertex_count);
  indices.allocate(index_count);
  for (size_t i = 0; i < source.parts.size(); ++i) {
    const sgm::MeshPart* part = source.parts[i];
    if (part == nullptr || part->vertices.empty()) continue;
    std::memcpy(vertices.data() + ranges[i].first_vertex, part->vertices.data(),
                part->vertices.size() * sizeof(sgm_vertex));
    std::transform(part->indices.begin(), part->indices.end(), indices.data() + ranges[i].first_index,
                   [first = ranges[i].first_vertex](uint32_t index) { return first + index; });
  }
  const std::span<const sgm_vertex> all(vertices.data(), vertices.size());
  bounds = boundsOf(grid, all);
  for (const sgm_vertex& v : all) {
    if (v.tag != 0 && (tags.empty() || tags.back() != v.tag)) tags.push_back(v.tag);
  }
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
}

void sgm_mesh_acquire(sgm_mesh* mesh) {
  if (mesh != nullptr) mesh->owners.fetch_add(1, std::memory_order_relaxed);
}

void sgm_mesh_release(sgm_mesh* mesh) {
  if (mesh != nullptr && mesh->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) endHandle(mesh);
}

sgm_result sgm_mesh_get_view(const sgm_mesh* mesh, sgm_mesh_view* view, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (mesh == nullptr) return nullArgument(error, "mesh");
    if (sgm_result r = checkDesc(error, view, "view"); r != SGM_OK) return r;
    view->key = mesh->key;
    view->cell_units = mesh->grid.cell;
    for (int axis = 0; axis < 3; ++axis) {
      view->origin[axis] = mesh->grid.origin[axis];
      view->bounds_min[axis] = mesh->bounds.lo[axis];
      view->bounds_max[axis] = mesh->bounds.hi[axis];
    }
    view->vertices = mesh->vertices.data();
    view->indices = mesh->indices.data();
    view->vertex_count = static_cast<uint32_t>(mesh->vertices.size());
    view->vertex_stride = sizeof(sgm_vertex);
    view->index_count = static_cast<uint32_t>(mesh->indices.size());
    view->index_stride = sizeof(uint32_t);
    view->body = mesh->ranges[0];
    std::copy(mesh->ranges.begin() + 1, mesh->ranges.end(), view->seams);
    view->hash = mesh->hash;
    view->anchors = mesh->anchors.data();
    view->anchor_count = static_cast<uint32_t>(mesh->anchors.size());
    view->anchor_stride = sizeof(sgm_anchor);
    view->tags = mesh->tags.data();
    view->tag_count = static_cast<uint32_t>(mesh->tags.size());
    view->reserved = 0;
    return SGM_OK;
  });
}

namespace {

/// Copies where there is room, and says how many there are.
template <class T>
sgm_result copyOut(const RawArray<T>& from, T* to, size_t stride, size_t* count) {
  const size_t room = *count;
  *count = from.size();
  if (to == nullptr) return SGM_OK;
  if (room < from.size()) return SGM_INCOMPLETE;
  if (stride == sizeof(T)) {
    if (from.size() > 0) std::memcpy(to, from.data(), from.size() * sizeof(T));
    return SGM_OK;
  }
  char* at = reinterpret_cast<char*>(to);
  for (size_t i = 0; i < from.size(); ++i, at += stride) std::memcpy(at, from.data() + i, sizeof(T));
  return SGM_OK;
}

}  // namespace

sgm_result sgm_mesh_copy(const sgm_mesh* mesh, sgm_vertex* vertices, size_t vertex_stride, size_t* vertex_count,
                         uint32_t* indices, size_t index_stride, size_t* index_count, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (mesh == nullptr) return nullArgument(error, "mesh");
    if (vertex_count == nullptr) return nullArgument(error, "vertex_count");
    if (index_count == nullptr) return nullArgument(error, "index_count");
    if (sgm_result r = checkStride<sgm_vertex>(error, vertex_stride, "vertex_stride"); r != SGM_OK) return r;
    if (sgm_result r = checkStride<uint32_t>(error, index_stride, "index_stride"); r != SGM_OK) return r;
    const sgm_result first = copyOut(mesh->vertices, vertices, vertex_stride, vertex_count);
    const sgm_result second = copyOut(mesh->indices, indices, index_stride, index_count);
    return first != SGM_OK ? first : second;
  });
}

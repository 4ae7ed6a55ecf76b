#include "api/mesh.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "api/anchors.h"
#include "api/barrier.h"

using namespace sgm::api;

static_assert(sizeof(sgm_vertex) == sizeof(sgm::Vertex) &&
              offsetof(sgm_vertex, material) == offsetof(sgm::Vertex, material) &&
              offsetof(sgm_vertex, normal_x) == offsetof(sgm::Vertex, normal_x) &&
              offsetof(sgm_vertex, tag) == offsetof(sgm::Vertex, tag) &&
              offsetof(sgm_vertex, kind) == offsetof(sgm::Vertex, kind));
static_assert(sizeof(sgm_wedge) == sizeof(sgm::Wedge) && offsetof(sgm_wedge, u) == offsetof(sgm::Wedge, u) &&
              offsetof(sgm_wedge, v) == offsetof(sgm::Wedge, v) &&
              offsetof(sgm_wedge, materials) == offsetof(sgm::Wedge, materials) &&
              offsetof(sgm_wedge, share) == offsetof(sgm::Wedge, share) &&
              offsetof(sgm_wedge, plane_shares) == offsetof(sgm::Wedge, plane_shares));
static_assert(sizeof(sgm_instance_batch) == sizeof(sgm::InstanceBatch) &&
              offsetof(sgm_instance_batch, name) == offsetof(sgm::InstanceBatch, name) &&
              offsetof(sgm_instance_batch, count) == offsetof(sgm::InstanceBatch, count) &&
              sizeof(sgm::InstanceTransform) == 12 * sizeof(float));
static_assert(SGM_VERTEX_OWN == int{sgm::kOwnEdge} && SGM_VERTEX_COARSER == int{sgm::kCoarserEdge} &&
              SGM_VERTEX_LATERAL == int{sgm::kLateralEdge});
static_assert(SGM_CHUNK_CELLS == sgm::kChunkCells && SGM_SUBCELL == sgm::kSubcell &&
              SGM_UNITS_PER_METRE == sgm::kUnitsPerMetre);

namespace {

sgm_mesh_range rangeOf(const sgm::PackedRange& range) {
  return {range.first_vertex, range.vertex_count, range.first_index, range.index_count, range.hash.value()};
}

}  // namespace

sgm_mesh::sgm_mesh(sgm_runtime& runtime_in, std::shared_ptr<const sgm::ChunkSurface> surface_in)
    : runtime(runtime_in), surface(std::move(surface_in)), anchors(&runtime_in.memory) {
  anchors.reserve(surface->anchors.size());
  for (const sgm::Anchor& anchor : surface->anchors) anchors.push_back(anchorOf(anchor));
}

sgm_result sgm_mesh_acquire(sgm_mesh* mesh) { return acquireHandle(mesh, __func__); }

sgm_result sgm_mesh_release(sgm_mesh* mesh) { return releaseHandle(mesh, __func__); }

sgm_result sgm_mesh_get_view(const sgm_mesh* mesh, sgm_mesh_view* view, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (mesh == nullptr) return nullArgument(error, "mesh");
    if (sgm_result r = checkDesc(error, view, "view"); r != SGM_OK) return r;
    const sgm::ChunkSurface& surface = *mesh->surface;
    view->key = {surface.key.level, surface.key.at.x, surface.key.at.y, surface.key.at.z};
    view->cell_units = surface.grid.cell;
    for (int axis = 0; axis < 3; ++axis) {
      view->origin[axis] = surface.grid.origin[axis];
      view->bounds_min[axis] = surface.bounds.lo[axis];
      view->bounds_max[axis] = surface.bounds.hi[axis];
    }
    // sgm_vertex and the internal vertex have the same layout, as the static assertions check.
    view->vertices = reinterpret_cast<const sgm_vertex*>(surface.mesh.vertices.data());
    view->indices = surface.mesh.indices.data();
    view->vertex_count = static_cast<uint32_t>(surface.mesh.vertices.size());
    view->vertex_stride = sizeof(sgm_vertex);
    view->index_count = static_cast<uint32_t>(surface.mesh.indices.size());
    view->index_stride = sizeof(uint32_t);
    view->body = rangeOf(surface.mesh.ranges[0]);
    std::transform(surface.mesh.ranges.begin() + 1, surface.mesh.ranges.end(), view->seams, rangeOf);
    view->hash = surface.hash.value();
    view->anchors = mesh->anchors.data();
    view->anchor_count = static_cast<uint32_t>(mesh->anchors.size());
    view->batches = reinterpret_cast<const sgm_instance_batch*>(surface.batches.data());
    view->batch_count = static_cast<uint32_t>(surface.batches.size());
    view->transforms = reinterpret_cast<const float*>(surface.transforms.data());
    view->morphs = surface.morphs.empty() ? nullptr : surface.morphs.front().data();
    view->wedges = reinterpret_cast<const sgm_wedge*>(surface.texture.wedges.data());
    view->wedge_count = static_cast<uint32_t>(surface.texture.wedges.size());
    view->wedge_indices = surface.texture.corners.data();
    view->wedge_stride = sizeof(sgm_wedge);
    view->anchor_stride = sizeof(sgm_anchor);
    view->tags = surface.tags.data();
    view->tag_count = static_cast<uint32_t>(surface.tags.size());
    return SGM_OK;
  });
}

namespace {

/// Copies as many elements as the caller's array can hold, and sets *count to the total number.
template <class T>
sgm_result copyOut(std::span<const T> from, T* to, size_t stride, size_t* count) {
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
    const sgm::PackedMesh& packed = mesh->surface->mesh;
    const std::span all(reinterpret_cast<const sgm_vertex*>(packed.vertices.data()), packed.vertices.size());
    const sgm_result first = copyOut(all, vertices, vertex_stride, vertex_count);
    const sgm_result second = copyOut(std::span<const uint32_t>(packed.indices), indices, index_stride, index_count);
    return first != SGM_OK ? first : second;
  });
}

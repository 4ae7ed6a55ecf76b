#pragma once
// An engine's copy of a streamed world: it stores the buffers of each chunk and, from the world's events, tracks which
// chunks are drawn.

#include <sgm/sgm.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "handles.h"

/// A mesh in the form in which a graphics device would store it.
struct DeviceMesh {
  std::vector<sgm_vertex> vertices;
  std::vector<uint32_t> indices;
  std::array<int32_t, 3> origin{};  ///< position of the chunk's corner in the world, in units
  float vertex_step = 0;            ///< metres for each step of a vertex coordinate
  sgm_mesh_range body{}, seams[SGM_FACE_COUNT]{};
  uint64_t hash = 0;
};

inline sgm_mesh_view viewOf(const sgm_mesh* mesh) {
  sgm_mesh_view view = SGM_MESH_VIEW_INIT;
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_mesh_get_view(mesh, &view, &error), error);
  return view;
}

/// Copies elements that lie `stride` bytes apart: in a later version of the library, elements may be larger than those
/// of the header with which this program was built.
template <class Element>
std::vector<Element> copyOf(const Element* elements, uint32_t count, uint32_t stride) {
  std::vector<Element> copy(count);
  const char* at = reinterpret_cast<const char*>(elements);
  for (uint32_t i = 0; i < count; ++i, at += stride) std::memcpy(&copy[i], at, sizeof(Element));
  return copy;
}

struct DrawCounts {
  size_t chunks = 0, triangles = 0;
  float farthest = 0;  ///< largest distance in metres on an axis from the camera to a chunk's origin
};

class Scene {
 public:
  using Key = std::array<int32_t, 4>;
  static Key keyOf(const sgm_chunk_key& key) { return {key.level, key.x, key.y, key.z}; }

  /// Processes an event of the world, and becomes the owner of its mesh.
  void take(const sgm_world_event& event) {
    const Key key = keyOf(event.key);
    switch (event.kind) {
      case SGM_EVENT_READY:
        chunks_[key].ready = upload(MeshOwner(event.mesh));
        return;
      case SGM_EVENT_SHOWN:
      case SGM_EVENT_REPLACED:
        chunks_[key].drawn = std::exchange(chunks_[key].ready, {});
        chunks_[key].seams = event.seams;
        chunks_[key].shown = true;
        return;
      case SGM_EVENT_SEAMS:
        chunks_[key].seams = event.seams;
        return;
      case SGM_EVENT_REMOVED:
        chunks_.erase(key);
        return;
      case SGM_EVENT_COLLIDER:
        sgm_collider_release(event.collider);  // an engine passes the collider's triangles to its physics
        return;
      case SGM_EVENT_COLLIDER_REMOVED:
        return;
      default:
        throw std::runtime_error(std::string("a chunk cannot be made: ") + sgm_result_name(event.result));
    }
  }

  /// Simulates drawing relative to the camera. The positions of camera and chunks are integers, and so are their
  /// differences; only these small differences become floats. A vertex is drawn at offset + vertex_step * (x, y, z).
  DrawCounts draw(const std::array<int32_t, 3>& camera) const {
    DrawCounts counts;
    for (const auto& [key, chunk] : chunks_) {
      if (!chunk.shown) continue;
      for (size_t axis = 0; axis < 3; ++axis) {
        const int64_t units = int64_t{chunk.drawn.origin[axis]} - camera[axis];
        const auto offset = static_cast<float>(units);
        if (static_cast<int64_t>(offset) != units) throw std::runtime_error("a chunk is too far away for a float");
        counts.farthest = std::max(counts.farthest, std::abs(offset) / SGM_UNITS_PER_METRE);
      }
      ++counts.chunks;
      counts.triangles += chunk.drawn.body.index_count / 3;
      for (uint32_t face = 0; face < SGM_FACE_COUNT; ++face) {
        if ((chunk.seams >> face & 1u) != 0) counts.triangles += chunk.drawn.seams[face].index_count / 3;
      }
    }
    return counts;
  }

  /// Whether exactly these chunks are drawn, with these meshes and seams.
  bool draws(const std::vector<sgm_drawn_chunk>& all) const {
    size_t shown = 0;
    for (const auto& [key, chunk] : chunks_) shown += chunk.shown ? 1 : 0;
    for (const sgm_drawn_chunk& wanted : all) {
      const auto found = chunks_.find(keyOf(wanted.key));
      if (found == chunks_.end() || !found->second.shown) return false;
      if (found->second.seams != wanted.seams || found->second.drawn.hash != viewOf(wanted.mesh).hash) return false;
    }
    return shown == all.size();
  }

  size_t uploadedBytes() const { return uploaded_; }

 private:
  struct Chunk {
    DeviceMesh ready, drawn;
    uint32_t seams = 0;
    bool shown = false;
  };

  /// Copies a mesh to the device. Afterwards the engine no longer needs the mesh; the world holds its own reference.
  DeviceMesh upload(const MeshOwner& mesh) {
    const sgm_mesh_view view = viewOf(mesh.get());
    DeviceMesh device;
    device.vertices = copyOf(view.vertices, view.vertex_count, view.vertex_stride);
    device.indices = copyOf(view.indices, view.index_count, view.index_stride);
    device.hash = view.hash;
    device.vertex_step = static_cast<float>(view.cell_units) / (SGM_SUBCELL * SGM_UNITS_PER_METRE);
    device.body = view.body;
    for (size_t axis = 0; axis < 3; ++axis) device.origin[axis] = view.origin[axis];
    for (size_t face = 0; face < SGM_FACE_COUNT; ++face) device.seams[face] = view.seams[face];
    uploaded_ += view.vertex_count * sizeof(sgm_vertex) + view.index_count * sizeof(uint32_t);
    return device;
  }

  std::map<Key, Chunk> chunks_;
  size_t uploaded_ = 0;
};

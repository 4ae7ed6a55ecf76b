#pragma once
// An engine's view of a streamed world whose meshes lie on its device: the meshes of each chunk, which of them are
// drawn, and removed meshes that the device may still be drawing.

#include <sgm/sgm.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "../embed/handles.h"
#include "draw_list.h"
#include "mesh_buffers.h"
#include "view_point.h"
#include "vulkan_device.h"

inline ChunkName nameOf(const sgm_chunk_key& key) { return {key.level, key.x, key.y, key.z}; }

/// The record of a chunk relative to the camera. The vertex shader computes in 1/256 of a unit, so the distance must be
/// less than 8,192 m.
inline ChunkRecord recordOf(const sgm_mesh_view& mesh, const UnitPlace& camera) {
  constexpr int64_t kFarthest = 8000 * SGM_UNITS_PER_METRE;
  const int64_t edge = int64_t{SGM_CHUNK_CELLS} * mesh.cell_units;
  ChunkRecord record{{}, mesh.cell_units};
  for (size_t axis = 0; axis < 3; ++axis) {
    const int64_t offset = int64_t{mesh.origin[axis]} - camera[axis];
    if (std::abs(offset) + edge > kFarthest) throw std::runtime_error("a chunk is too far away for the vertex shader");
    record.offset[axis] = static_cast<int32_t>(offset);
  }
  return record;
}

/// The device must have completed all frames that draw its meshes before the scene is destroyed.
class Scene {
 public:
  explicit Scene(const VulkanDevice& device) : device_(device) {}

  /// Processes an event, and becomes the owner of its mesh. submitted: number of the last submitted frame, which may
  /// still draw the mesh that is replaced.
  void take(const sgm_world_event& event, uint64_t submitted) {
    const ChunkName name = nameOf(event.key);
    switch (event.kind) {
      case SGM_EVENT_READY:
        retire(std::exchange(chunks_[name].ready, arrive(event.mesh)), submitted);
        return;
      case SGM_EVENT_SHOWN:
      case SGM_EVENT_REPLACED: {
        Chunk& chunk = chunks_[name];
        retire(std::exchange(chunk.drawn, std::exchange(chunk.ready, {})), submitted);
        chunk.seams = event.seams;
        chunk.shown = true;
        return;
      }
      case SGM_EVENT_SEAMS:
        chunks_[name].seams = event.seams;
        return;
      case SGM_EVENT_REMOVED: {
        const auto gone = chunks_.find(name);
        if (gone == chunks_.end()) throw std::runtime_error("a chunk is removed that was not there");
        retire(std::move(gone->second.drawn), submitted);
        chunks_.erase(gone);
        return;
      }
      case SGM_EVENT_COLLIDER:
        sgm_collider_release(event.collider);
        return;
      case SGM_EVENT_COLLIDER_REMOVED:
        return;
      default:
        throw std::runtime_error(std::string("a chunk cannot be made: ") + sgm_result_name(event.result));
    }
  }

  /// Releases removed meshes that were last drawn in a completed frame.
  void release(uint64_t ended) {
    while (!retired_.empty() && retired_.front().first <= ended) retired_.pop_front();
  }

  DrawList drawList(const UnitPlace& camera) const {
    DrawList list;
    for (const auto& [name, chunk] : chunks_) {
      if (!chunk.shown) continue;
      const StreamedMesh& mesh = chunk.drawn;
      const auto record = static_cast<uint32_t>(list.records.size());
      list.records.push_back(recordOf(mesh.view(), camera));
      for (uint32_t part = 0; part < mesh.parts().size(); ++part) {
        const auto& [buffer, command] = mesh.parts()[part];
        if (buffer == VK_NULL_HANDLE || (part > 0 && (chunk.seams >> (part - 1) & 1u) == 0)) continue;
        list.draws.push_back({buffer, command, name, part});
        list.draws.back().command.firstInstance = record;
      }
      // All meshes have the same semaphore, so waiting for the largest of their values suffices.
      if (!mesh.resident()) continue;
      list.semaphore = mesh.semaphore();
      list.value = std::max(list.value, mesh.value());
    }
    list.sortByBuffer();
    return list;
  }

  size_t residentChunks() const { return resident_; }
  size_t residentBytes() const { return resident_bytes_; }  ///< total of all meshes that arrived in device memory

 private:
  struct Chunk {
    StreamedMesh ready, drawn;
    uint32_t seams = 0;
    bool shown = false;
  };

  StreamedMesh arrive(sgm_mesh* mesh) {
    StreamedMesh arrived(device_, MeshOwner(mesh));
    if (arrived.resident()) {
      ++resident_;
      resident_bytes_ += arrived.bytes();
    }
    return arrived;
  }
  void retire(StreamedMesh&& mesh, uint64_t submitted) {
    if (mesh) retired_.emplace_back(submitted, std::move(mesh));
  }

  const VulkanDevice& device_;
  std::map<ChunkName, Chunk> chunks_;
  // Removed meshes, with the number of the last frame that may draw them.
  std::deque<std::pair<uint64_t, StreamedMesh>> retired_;
  size_t resident_ = 0, resident_bytes_ = 0;
};

#pragma once
// Draws the same frame again as an engine without shared device memory does: from the world's list of drawn chunks, and
// from the meshes' bytes on the host.

#include <sgm/sgm.h>

#include <cstddef>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "../embed/handles.h"
#include "draw_list.h"
#include "frames.h"
#include "mesh_buffers.h"
#include "picture.h"
#include "scene.h"
#include "view_point.h"

class UploadedPath {
 public:
  UploadedPath(VulkanDevice& device, const ChunkPipeline& pipeline) : device_(device), frames_(device, pipeline, 1) {}

  /// Draws in the order of `other`, so that surfaces at equal depth give the same picture. Throws if `other` does not
  /// contain exactly the chunks that the world draws: then its events were processed wrongly.
  Picture draw(sgm_world* world, const DrawList& other, const UnitPlace& camera, const Matrix& matrix) {
    size_t count = 0;
    sgm_error error = SGM_ERROR_INIT;
    must(sgm_world_get_drawn(world, nullptr, 0, &count, &error), error);
    std::vector<sgm_drawn_chunk> chunks(count);
    must(sgm_world_get_drawn(world, chunks.data(), 0, &count, &error), error);
    std::vector<MeshOwner> meshes;
    for (const sgm_drawn_chunk& chunk : chunks) meshes.emplace_back(chunk.mesh);
    std::vector<sgm_mesh_view> views;
    for (const MeshOwner& mesh : meshes) views.push_back(viewOf(mesh.get()));
    const UploadedMeshes uploaded(device_, views);
    DrawList list;
    std::map<std::pair<ChunkName, uint32_t>, Draw> drawn;
    for (size_t i = 0; i < chunks.size(); ++i) {
      const ChunkName name = nameOf(chunks[i].key);
      for (uint32_t part = 0; part < uploaded.parts(i).size(); ++part) {
        const auto& [buffer, command] = uploaded.parts(i)[part];
        if (buffer == VK_NULL_HANDLE || (part > 0 && (chunks[i].seams >> (part - 1) & 1u) == 0)) continue;
        Draw& draw = drawn[{name, part}] = {buffer, command, name, part};
        draw.command.firstInstance = static_cast<uint32_t>(i);
      }
      list.records.push_back(recordOf(views[i], camera));
    }
    for (const Draw& wanted : other.draws) {
      const auto found = drawn.find({wanted.chunk, wanted.part});
      if (found != drawn.end()) list.draws.push_back(found->second);
    }
    if (list.draws.size() != other.draws.size() || list.draws.size() != drawn.size()) {
      throw std::runtime_error("the events do not lead to what the world draws");
    }
    frames_.draw(list, matrix);
    return frames_.picture();
  }

 private:
  VulkanDevice& device_;
  Frames frames_;
};

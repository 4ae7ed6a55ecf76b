#include "stream/chunk_surface.h"

namespace sgm {

MeshParts partsOf(const ChunkMesh& mesh) {
  MeshParts parts{&mesh.body};
  for (size_t f = 0; f < mesh.seams.size(); ++f) parts[1 + f] = &mesh.seams[f];
  return parts;
}

ChunkSurface surfaceOf(const ChunkRequest& request, PlacedChunk&& chunk, const ChunkSurface* before,
                       std::pmr::memory_resource* memory) {
  MeshParts parts = partsOf(chunk.mesh);
  if (!request.body) parts[0] = nullptr;
  for (size_t f = 0; f < 6; ++f) {
    if (!(request.seams >> f & 1)) parts[1 + f] = nullptr;
  }
  ChunkSurface surface(memory);
  surface.key = chunk.key;
  surface.grid = chunk.grid;
  surface.mesh = packMesh(parts, before != nullptr ? &before->mesh : nullptr, memory);
  surface.seams = static_cast<uint8_t>(request.seams | (before != nullptr ? before->seams : 0));
  surface.bounds = boundsOf(chunk.grid, surface.mesh.vertices);
  surface.tags = tagsOf(surface.mesh.vertices, memory);
  if (request.body || before == nullptr) {
    surface.anchors = std::move(chunk.anchors);
  } else {
    surface.anchors = before->anchors;
  }
  surface.hash = hashOf(surface.mesh, chunk.grid);
  return surface;
}

}  // namespace sgm

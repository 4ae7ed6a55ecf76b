#include "chunk/chunk_surface.h"

#include <algorithm>
#include <tuple>

namespace sgm {

namespace {

InstanceTransform transformOf(const Frame& frame, const ChunkGrid& grid) {
  InstanceTransform t{};
  for (size_t row = 0; row < 3; ++row) {
    // The matrix of the frame converts from world axes to the anchor's axes; its transpose converts back.
    for (size_t column = 0; column < 3; ++column) t[row * 4 + column] = frame.rows[column * 3 + row];
    const auto axis = static_cast<int>(row);
    t[row * 4 + 3] =
        static_cast<float>(static_cast<double>(int64_t{frame.origin[axis]} - grid.origin[axis]) / kUnitsPerMetre);
  }
  return t;
}

void placeAnchors(std::vector<Anchor>&& anchors, ChunkSurface& surface) {
  std::sort(anchors.begin(), anchors.end(), [](const Anchor& a, const Anchor& b) {
    return std::tie(a.kind, a.name, a.key.value) < std::tie(b.kind, b.name, b.key.value);
  });
  surface.anchors = std::move(anchors);
  surface.transforms.reserve(surface.anchors.size());
  for (const Anchor& anchor : surface.anchors) {
    if (surface.batches.empty() || surface.batches.back().kind != anchor.kind ||
        surface.batches.back().name != anchor.name) {
      surface.batches.push_back({anchor.kind, anchor.name, static_cast<uint32_t>(surface.transforms.size()), 0});
    }
    ++surface.batches.back().count;
    surface.transforms.push_back(transformOf(anchor.frame, surface.grid));
  }
}

}  // namespace

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
  surface.mesh = before == nullptr && request.body && request.seams == 0
                     ? packBody(std::move(chunk.mesh.body), memory)
                     : packMesh(parts, before != nullptr ? &before->mesh : nullptr, memory);
  for (size_t p = 0; p < parts.size(); ++p) {
    if (parts[p] != nullptr) {
      surface.on_device[p] = std::move(chunk.mesh.on_device[p]);
    } else if (before != nullptr) {
      surface.on_device[p] = before->on_device[p];
    }
  }
  surface.seams = static_cast<uint8_t>(request.seams | (before != nullptr ? before->seams : 0));
  surface.bounds = boundsOf(chunk.grid, surface.mesh.vertices);
  surface.tags = tagsOf(surface.mesh.vertices, memory);
  if (request.body || before == nullptr) {
    placeAnchors(std::move(chunk.anchors), surface);
  } else {
    surface.anchors = before->anchors;
    surface.transforms = before->transforms;
    surface.batches = before->batches;
  }
  surface.hash = hashOf(surface.mesh, chunk.grid);
  return surface;
}

}  // namespace sgm

#include "metrics/solid_volume.h"

#include <algorithm>

namespace sgm {
namespace {

constexpr size_t kChunksTogether = 4096;  ///< whose meshes are there at one time

uint8_t facesIn(const ChunkKey& key, const ChunkKey& first, const ChunkKey& last) {
  uint8_t faces = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (key.at[axis] == first.at[axis]) faces |= static_cast<uint8_t>(1 << (2 * axis));
    if (key.at[axis] == last.at[axis]) faces |= static_cast<uint8_t>(1 << (2 * axis + 1));
  }
  return faces;
}

}  // namespace

std::array<double, 3> originFrom(Int3 place, const ChunkGrid& grid) {
  std::array<double, 3> from{};
  for (int axis = 0; axis < 3; ++axis)
    from[static_cast<size_t>(axis)] = static_cast<double>(int64_t{grid.origin[axis]} - place[axis]) / kUnitsPerMetre;
  return from;
}

Result<double> borderFlux(const WorldField& world, Backend& backend, JobSystem& jobs, std::span<const ChunkKey> keys,
                          bool sharp) {
  const Result<ChunkGrid> lowest = chunkGrid(world, keys.front());
  if (!lowest) return lowest.error();
  std::pmr::vector<ChunkRequest> requests(world.memory());
  for (const ChunkKey& key : keys) {
    const uint8_t faces = facesIn(key, keys.front(), keys.back());
    if (faces == 0) continue;
    // The seams to the domain's own state, as a world has them at its end, fill what the border cuts.
    ChunkRequest& request = requests.emplace_back(ChunkRequest{key, faces});
    request.outermost = true;
    request.sharp = sharp;
    request.body = false;
    request.keys = sharp;
    request.sums_only = !sharp;
  }
  double flux = 0;
  for (size_t first = 0; first < requests.size(); first += kChunksTogether) {
    const auto together = std::span(requests).subspan(first, std::min(kChunksTogether, requests.size() - first));
    const Result<std::pmr::vector<PlacedChunk>> chunks = meshChunks(world, backend, jobs, together);
    if (!chunks) return chunks.error();
    for (const PlacedChunk& chunk : *chunks) {
      const std::array<double, 3> origin = originFrom(lowest->origin, chunk.grid);
      for (size_t face = 0; face < chunk.mesh.seams.size(); ++face) {
        const MeshPart& seam = chunk.mesh.seams[face];
        flux +=
            fluxOf(sharp ? sumsOf(seam.vertices, seam.indices) : chunk.mesh.sums[1 + face], chunk.grid.cell, origin);
      }
    }
  }
  return flux;
}

double solidVolume(const WorldField& world, const IntBox& region, double flux) {
  if (!world.isSolidDomain()) return flux;
  // The surface bounds what is not solid.
  double volume = 1;
  for (int axis = 0; axis < 3; ++axis)
    volume *= static_cast<double>(int64_t{region.hi[axis]} - region.lo[axis]) / kUnitsPerMetre;
  return volume + flux;
}

}  // namespace sgm

#pragma once
// Assembles a chunk's mesh from the results of a device of any kind, in host memory.

#include <bit>
#include <cstdint>

#include "backend/backend.h"
#include "mesh/vertex_keys.h"

namespace sgm {

/// A body or a seam as a device returns it. A part without vertices does not exist in the chunk's mesh.
struct MadePart {
  const Vertex* vertices = nullptr;
  const uint32_t* indices = nullptr;
  uint32_t vertex_count = 0, index_count = 0;
  ContentHash hash;
  PartSums sums = {};  ///< set only for ChunkJob::sums_only; then the other members are empty
};

/// Fills the mesh of a chunk. signsOfRow(y + 33 z): returns the signs of the row's 33 samples, x from bit 0 on; called
/// only if a body is requested. partOf(p): returns the part with index p in DeviceParts. Throws std::bad_alloc.
template <class SignsOfRow, class PartOf>
void readChunk(const ChunkJob& job, const SignsOfRow& signsOfRow, const PartOf& partOf, ChunkMesh& mesh) {
  constexpr uint32_t kRows = uint32_t{kChunkSamples} * kChunkSamples;
  const auto fill = [&](size_t number, MeshPart& part) {
    const MadePart made = partOf(number);
    if (job.sums_only) mesh.sums[number] = made.sums;
    if (made.vertex_count == 0) return;
    part.vertices.assign(made.vertices, made.vertices + made.vertex_count);
    part.indices.assign(made.indices, made.indices + made.index_count);
    part.hash = made.hash;
    if (job.keys) deriveKeys(job.grid, static_cast<int>(number), job.coarser, part);
  };
  if (job.body) {
    constexpr uint64_t kLower = (uint64_t{1} << kChunkCells) - 1;
    uint32_t all = 0;
    for (uint32_t row = 0; row < kRows; ++row) {
      const uint64_t signs = signsOfRow(row);
      all += static_cast<uint32_t>(std::popcount(signs));
      const bool lower = row % kChunkSamples < kChunkCells && row / kChunkSamples < kChunkCells;
      if (lower) mesh.solid_samples += static_cast<uint32_t>(std::popcount(signs & kLower));
    }
    mesh.uniform = all == 0 || all == kRows * kChunkSamples;
    if (job.signs && !mesh.uniform) {
      mesh.signs.resize(kRows);
      for (uint32_t row = 0; row < kRows; ++row) mesh.signs[row] = signsOfRow(row);
    }
    if (!mesh.uniform) fill(0, mesh.body);
  }
  if (job.seams == 0) return;
  mesh.seams.reserve(6);
  for (size_t face = 0; face < 6; ++face) {
    fill(1 + face, mesh.seams.emplace_back(mesh.body.vertices.get_allocator().resource()));
  }
}

}  // namespace sgm

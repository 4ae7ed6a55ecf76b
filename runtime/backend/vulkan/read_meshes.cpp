#include "backend/vulkan/read_meshes.h"

#include <bit>

#include "mesh/vertex_keys.h"

namespace sgm::vulkan {

namespace {

constexpr size_t kRows = size_t{kChunkSamples} * kChunkSamples;

bool hasRoom(const Mesher::Output& output, uint32_t part) {
  return part == batch::kNoRoom || output.parts[part].first_vertex != batch::kNoRoom;
}

void readPart(const Mesher::Output& output, uint32_t number, const ChunkJob& job, int part_of_chunk, MeshPart& part) {
  const batch::Part& record = output.parts[number];
  part.vertices.assign(output.vertices + record.first_vertex, output.vertices + record.first_vertex + record.vertices);
  part.indices.assign(output.indices + record.first_index, output.indices + record.first_index + record.indices);
  part.hash = {record.hash[0], record.hash[1]};
  deriveKeys(job.grid, part_of_chunk, job.coarser, part);
}

}  // namespace

bool readMesh(const BatchPlan& plan, const Mesher::Output& output, size_t chunk, const ChunkJob& job, ChunkMesh& mesh) {
  const BatchPlan::Chunk& planned = plan.chunks[chunk];
  if (!hasRoom(output, planned.body)) return false;
  for (const uint32_t seam : planned.seams) {
    if (!hasRoom(output, seam)) return false;
  }
  if (job.body) {
    const uint32_t* signs = output.signs + (output.signs_in_place ? planned.signs : chunk * batch::kSignWords);
    uint32_t solid = 0, all = 0;
    for (size_t row = 0; row < kRows; ++row) {
      const auto count = static_cast<uint32_t>(std::popcount(signs[2 * row]));
      all += count + (signs[2 * row + 1] & 1);
      if (row % kChunkSamples < kChunkCells && row / kChunkSamples < kChunkCells) solid += count;
    }
    mesh.solid_samples = solid;
    mesh.uniform = all == 0 || all == kRows * kChunkSamples;
    if (job.signs && !mesh.uniform) {
      mesh.signs.resize(kRows);
      for (size_t row = 0; row < kRows; ++row) {
        mesh.signs[row] = signs[2 * row] | uint64_t{signs[2 * row + 1] & 1} << 32;
      }
    }
    if (!mesh.uniform) readPart(output, planned.body, job, 0, mesh.body);
  }
  if (job.seams == 0) return true;
  mesh.seams.reserve(6);
  for (size_t face = 0; face < 6; ++face) {
    MeshPart& seam = mesh.seams.emplace_back(mesh.body.vertices.get_allocator().resource());
    if (planned.seams[face] == batch::kNoRoom) continue;
    if (output.parts[planned.seams[face]].vertices > 0) {
      readPart(output, planned.seams[face], job, 1 + static_cast<int>(face), seam);
    }
  }
  return true;
}

PartSources sourcesOf(const BatchPlan& plan, const Mesher::Output& output, size_t chunk, const BatchBuffers& buffers) {
  const BatchPlan::Chunk& planned = plan.chunks[chunk];
  PartSources sources;
  for (size_t p = 0; p < sources.size(); ++p) {
    const uint32_t number = p == 0 ? planned.body : planned.seams[p - 1];
    if (number == batch::kNoRoom || output.parts[number].indices == 0) continue;
    const batch::Part& part = output.parts[number];
    sources[p] = {BufferRange(buffers.vertices, part.first_vertex * uint64_t{sizeof(Vertex)},
                              part.vertices * uint64_t{sizeof(Vertex)}),
                  BufferRange(buffers.indices, part.first_index * uint64_t{sizeof(uint32_t)},
                              part.indices * uint64_t{sizeof(uint32_t)})};
  }
  return sources;
}

}  // namespace sgm::vulkan

#include "backend/vulkan/read_meshes.h"

#include "backend/read_chunk.h"

namespace sgm::vulkan {

namespace {

bool hasRoom(const Mesher::Output& output, uint32_t part) {
  return part == batch::kNoRoom || output.parts[part].first_vertex != batch::kNoRoom;
}

uint32_t partOf(const BatchPlan::Chunk& planned, size_t number) {
  return number == 0 ? planned.body : planned.seams[number - 1];
}

int64_t wideOf(const uint32_t (&words)[2]) { return static_cast<int64_t>(words[0] | uint64_t{words[1]} << 32); }

PartSums sumsOf(const batch::Part& part, const batch::Sums& made) {
  PartSums sums;
  sums.triangles = part.indices / 3;
  sums.area = wideOf(made.area);
  for (size_t axis = 0; axis < 3; ++axis) sums.cross[axis] = wideOf(made.cross[axis]);
  sums.six_volumes = wideOf(made.six_volumes);
  return sums;
}

}  // namespace

bool readMesh(const BatchPlan& plan, const Mesher::Output& output, size_t chunk, const ChunkJob& job, ChunkMesh& mesh) {
  const BatchPlan::Chunk& planned = plan.chunks[chunk];
  for (size_t p = 0; p < kMeshParts; ++p) {
    if (!hasRoom(output, partOf(planned, p))) return false;
  }
  const uint32_t* signs = output.signs + (output.signs_in_place ? planned.signs : chunk * batch::kSignWords);
  const auto signsOfRow = [&](uint32_t row) { return signs[2 * row] | uint64_t{signs[2 * row + 1] & 1} << 32; };
  const auto made = [&](size_t p) -> MadePart {
    const uint32_t number = partOf(planned, p);
    if (number == batch::kNoRoom) return {};
    const batch::Part& part = output.parts[number];
    if (job.sums_only) return {nullptr, nullptr, 0, 0, {}, sumsOf(part, output.sums[number])};
    return {output.vertices + part.first_vertex,
            output.indices + part.first_index,
            part.vertices,
            part.indices,
            {part.hash[0], part.hash[1]},
            {}};
  };
  readChunk(job, signsOfRow, made, mesh);
  return true;
}

PartSources sourcesOf(const BatchPlan& plan, const Mesher::Output& output, size_t chunk, const BatchBuffers& buffers) {
  const BatchPlan::Chunk& planned = plan.chunks[chunk];
  PartSources sources;
  for (size_t p = 0; p < sources.size(); ++p) {
    const uint32_t number = partOf(planned, p);
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

#include "query/sign_window.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "backend/cpu/instruction_sets.h"
#include "backend/cpu/mesh_chunk.h"
#include "chunk/mesh_chunks.h"

namespace sgm {

SignField signField(QueryField field) {
  const int32_t cell = field.finest_cell;
  std::pmr::memory_resource* memory = field.memory;
  return {[field = std::move(field)](Int3 chunk) -> Result<ChunkSigns> {
            ChunkGrid grid;
            grid.cell = field.finest_cell;
            for (int axis = 0; axis < 3; ++axis)
              grid.origin[axis] = saturate(int64_t{chunk[axis]} * kChunkCells * grid.cell);
            const Result<std::shared_ptr<const FieldProgram>> program = field.at(chunkBox(grid));
            if (!program) return program.error();
            ChunkScratch scratch(field.memory);
            const bool mixed = sampleChunk(bestChunkKernels(), (*program)->view(), grid, scratch);
            if (mixed) return ChunkSigns{std::move(scratch.samples.signs), false};
            return ChunkSigns{std::pmr::vector<uint64_t>(field.memory), (scratch.samples.signs[0] & 1) != 0};
          },
          cell, memory};
}

Result<void> SignWindow::add(std::span<const Int3> chunks, JobSystem& jobs) {
  std::vector<Int3> missing;
  for (const Int3 chunk : chunks) {
    if (!chunks_.contains(chunk)) missing.push_back(chunk);
  }
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  std::vector<std::optional<Result<ChunkSigns>>> found(missing.size());
  parallelFor(jobs, missing.size(), [&](size_t i) { found[i] = field_.signs(missing[i]); });
  for (size_t i = 0; i < missing.size(); ++i) {
    if (!*found[i]) return found[i]->error();
    chunks_.emplace(missing[i], std::move(**found[i]));
  }
  return {};
}

std::pmr::vector<uint16_t> SignWindow::clearance(Int3 chunk, int most) const {
  ChunkSignsAround around;
  around.fill(&at(chunk));
  if (most > 1) {
    const std::vector<Int3> chunks = chunksAround(chunk, 1);
    for (size_t i = 0; i < around.size(); ++i) around[i] = &at(chunks[i]);
  }
  return squaredClearance(around, most, field_.memory);
}

std::vector<Int3> chunksAround(Int3 chunk, int rings) {
  std::vector<Int3> chunks;
  for (int z = -rings; z <= rings; ++z) {
    for (int y = -rings; y <= rings; ++y) {
      for (int x = -rings; x <= rings; ++x) chunks.push_back({chunk.x + x, chunk.y + y, chunk.z + z});
    }
  }
  return chunks;
}

}  // namespace sgm

#include "chunk/world_measures.h"

#include <chrono>

#include "measure/measure_chunk.h"

namespace sgm {

MeasuringPool::MeasuringPool(std::pmr::memory_resource* memory) : memory_(memory) {}
MeasuringPool::~MeasuringPool() = default;

std::unique_ptr<measure::MeasureScratch> MeasuringPool::take() {
  {
    const std::lock_guard lock(mutex_);
    if (!free_.empty()) {
      std::unique_ptr<measure::MeasureScratch> scratch = std::move(free_.back());
      free_.pop_back();
      return scratch;
    }
  }
  return std::make_unique<measure::MeasureScratch>(memory_);
}

void MeasuringPool::give(std::unique_ptr<measure::MeasureScratch> scratch) {
  const std::lock_guard lock(mutex_);
  free_.push_back(std::move(scratch));
}

measure::ChunkMeasures measureParts(const ChunkRequest& request, const PlacedChunk& chunk, const ChunkSurface* before,
                                    MeasuringPool& pool, MadeMeasures& made) {
  const auto begun = std::chrono::steady_clock::now();
  measure::ChunkMeasures measures;
  if (before != nullptr && before->measures) measures = *before->measures;
  if (request.body) {
    std::unique_ptr<measure::MeasureScratch> scratch = pool.take();
    measure::measureBody(measure::viewOf(chunk.mesh.body), chunk.mesh.signs, *scratch, measures);
    pool.give(std::move(scratch));
  }
  for (size_t face = 0; face < chunk.mesh.seams.size(); ++face) {
    if (!(request.seams >> face & 1)) continue;
    measures.parts[1 + face] = measure::measureSeam(measure::viewOf(chunk.mesh.seams[face]));
  }
  made.sums.add(measures, chunk.grid, request.body, request.seams);
  made.measuring += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return measures;
}

}  // namespace sgm

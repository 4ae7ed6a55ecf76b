#pragma once
// Measures of a streamed world's chunks. Each measure is taken in the job that has meshed the chunk or has read it from
// the disk.

#include <memory>
#include <mutex>
#include <vector>

#include "chunk/chunk_surface.h"
#include "measure/chunk_measures.h"

namespace sgm {

namespace measure {
struct MeasureScratch;
}

/// Sums of the measures of all finished jobs.
struct MadeMeasures {
  measure::SurfaceSums sums;  ///< sums over all parts; a part that is made several times counts several times
  double measuring = 0;       ///< wall-clock seconds spent on measuring, summed over jobs
  double meshing = 0;         ///< wall-clock seconds spent on meshing, reading and packing chunks, summed over jobs

  void add(const MadeMeasures& other) {
    sums.add(other.sums);
    measuring += other.measuring;
    meshing += other.meshing;
  }
};

struct WorldMeasures {
  measure::SurfaceSums drawn;  ///< sums over the current frame: its bodies, and the seams drawn with them
  MadeMeasures made;
};

/// A pool of scratch memory: one object per thread that is measuring. Thread-safe.
class MeasuringPool {
 public:
  explicit MeasuringPool(std::pmr::memory_resource* memory);
  ~MeasuringPool();
  std::unique_ptr<measure::MeasureScratch> take();
  void give(std::unique_ptr<measure::MeasureScratch> scratch);

 private:
  std::pmr::memory_resource* memory_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<measure::MeasureScratch>> free_;
};

/// Measures the parts that were requested, and adds their measures to `made`. The measures of other parts are copied
/// from `before`, an earlier surface of the chunk with measures, or null. Throws std::bad_alloc.
measure::ChunkMeasures measureParts(const ChunkRequest& request, const PlacedChunk& chunk, const ChunkSurface* before,
                                    MeasuringPool& pool, MadeMeasures& made);

}  // namespace sgm

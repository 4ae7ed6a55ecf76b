#pragma once
// What is measured of the chunks of a streamed world, each in the job that has meshed it or read it from the disk.

#include <memory>
#include <mutex>
#include <vector>

#include "chunk/chunk_surface.h"
#include "measure/chunk_measures.h"

namespace sgm {

namespace measure {
struct MeasureScratch;
}

/// Of what jobs have made.
struct MadeMeasures {
  measure::SurfaceSums sums;  ///< of every part once each time that it was made
  double measuring = 0;       ///< seconds on the wall that it took, added up over jobs
  double meshing = 0;         ///< likewise, to mesh, read and pack the chunks

  void add(const MadeMeasures& other) {
    sums.add(other.sums);
    measuring += other.measuring;
    meshing += other.meshing;
  }
};

struct WorldMeasures {
  measure::SurfaceSums drawn;  ///< of the frame that is drawn: bodies, and the seams that are drawn with them
  MadeMeasures made;
};

/// Scratch memory for as many threads as measure at one time. Thread-safe.
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

/// Measures the parts that the request asks for, and adds them to `made`. Those of other parts are `before`'s, an
/// earlier surface of the chunk that was measured, or null. Throws std::bad_alloc.
measure::ChunkMeasures measureParts(const ChunkRequest& request, const PlacedChunk& chunk, const ChunkSurface* before,
                                    MeasuringPool& pool, MadeMeasures& made);

}  // namespace sgm

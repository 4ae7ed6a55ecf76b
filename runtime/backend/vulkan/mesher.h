#pragma once
// Runs the shaders of shaders/mesher/ on one device: a planned batch in, its parts out.

#include <array>
#include <atomic>
#include <memory>

#include "backend/vulkan/batch_plan.h"
#include "backend/vulkan/commands.h"
#include "backend/vulkan/kernels.h"

namespace sgm::vulkan {

/// The buffers of a batch in flight; reused from batch to batch, and grown if needed.
struct BatchBuffers {
  Buffer words, staging, scratch, parts, vertices, indices;
  /// Copies for the host, if it cannot read the device's buffers. The buffers of running batches form the ring for
  /// downloads. Only the device knows the numbers of vertices and indices. So as many as recent batches had are
  /// downloaded with the batch itself; if it has more, the rest follows.
  Buffer parts_back, signs_back, vertices_back, indices_back;
  uint64_t brought_vertices = 0, brought_indices = 0;  ///< bytes downloaded with the batch
  uint64_t reading = 0;  ///< of the queue: until this value vertices and indices are being downloaded
};

/// Thread-safe. All constructor arguments must outlive it.
class Mesher {
 public:
  /// Errors: as Memory::buffer.
  static Result<std::unique_ptr<Mesher>> create(Queue& queue, Memory& memory, CommandRing& ring, Kernels& kernels);

  /// Submits the batch. Returns the queue's value at its end; until then the plan and the buffers must not change.
  /// Waits for missing pipelines (Kernels::get). Errors: device_lost, out_of_memory, limit, unsupported. Throws
  /// std::bad_alloc.
  Result<uint64_t> submit(const BatchPlan& plan, BatchBuffers& buffers);

  /// Call after the end of the submission with these two: returns the output for the host, valid until the next
  /// submission. Waits for the download of vertices and indices if needed; they are null if no chunk wants them.
  /// Errors: as submit.
  struct Output {
    const batch::Head* head = nullptr;
    const batch::Part* parts = nullptr;
    const batch::Sums* sums = nullptr;  ///< for the parts of chunks that request them
    const Vertex* vertices = nullptr;
    const uint32_t* indices = nullptr;
    const uint32_t* signs = nullptr;  ///< of the plan's chunks, one after the other, batch::kSignWords each
    bool signs_in_place = false;      ///< signs points to scratch: use each chunk's own offset
  };
  Result<Output> read(const BatchPlan& plan, BatchBuffers& buffers);

  uint32_t mostScratchWords() const;

 private:
  Mesher(Queue& queue, Memory& memory, CommandRing& ring, Kernels& kernels)
      : queue_(queue), memory_(memory), ring_(ring), kernels_(kernels) {}
  Result<void> fit(const BatchPlan& plan, BatchBuffers& buffers);
  Result<void> fitBack(const BatchPlan& plan, BatchBuffers& buffers);
  Result<void> bringLater(const batch::Head& head, BatchBuffers& buffers);
  Result<void> record(Commands& commands, const Pipelines& pipelines, const BatchPlan& plan, BatchBuffers& buffers);

  Queue& queue_;
  Memory& memory_;
  CommandRing& ring_;
  Kernels& kernels_;
  Buffer tables_;
  /// The sizes of the last batch, with a margin.
  std::atomic<uint64_t> usual_vertices_{0}, usual_indices_{0};
};

}  // namespace sgm::vulkan

#pragma once
// Runs the shaders of shaders/mesher/ on one device: submits a planned batch, and returns its parts.

#include <array>
#include <atomic>
#include <memory>

#include "backend/vulkan/batch_plan.h"
#include "backend/vulkan/commands.h"
#include "backend/vulkan/kernels.h"

namespace sgm::vulkan {

/// The buffers of one batch; reused for further batches, and enlarged if necessary.
struct BatchBuffers {
  Buffer words, staging, scratch, parts, vertices, indices;
  /// Buffers into which results are copied for the host; unused if the host can read the device's own buffers. The copy
  /// buffers of all running batches together form a ring for downloads. When the host submits a batch, it does not know
  /// the numbers of vertices and indices. So the submission downloads as many as recent batches had; if the batch has
  /// more, the rest is downloaded later.
  Buffer parts_back, signs_back, vertices_back, indices_back;
  /// bytes of vertices and of indices whose download is a part of the submission itself
  uint64_t brought_vertices = 0, brought_indices = 0;
  uint64_t reading = 0;  ///< timeline value of the queue at which the download of vertices and indices has ended
};

/// Runs the mesher's shaders on one device. Thread-safe. All arguments of create() must outlive it.
class Mesher {
 public:
  /// Creates a mesher. Errors: same as Memory::buffer.
  static Result<std::unique_ptr<Mesher>> create(Queue& queue, Memory& memory, CommandRing& ring, Kernels& kernels);

  /// Submits a planned batch. Returns the timeline value of the queue at its end; until then, the plan and the buffers
  /// must not change. Waits for missing pipelines (Kernels::get). Errors: device_lost, out_of_memory, limit,
  /// unsupported. Throws std::bad_alloc.
  Result<uint64_t> submit(const BatchPlan& plan, BatchBuffers& buffers);

  /// Returns the results in host memory, valid until the next submission. Call after the end of the submission with
  /// this plan and these buffers. Waits for the rest of the download if necessary. Vertices and indices are null if no
  /// chunk requests them. Errors: same as submit.
  struct Output {
    const batch::Head* head = nullptr;
    const batch::Part* parts = nullptr;
    const batch::Sums* sums = nullptr;  ///< sums of the parts of those chunks that request them
    const Vertex* vertices = nullptr;
    const uint32_t* indices = nullptr;
    /// signs of the plan's chunks, one chunk after the other, batch::kSignWords words each
    const uint32_t* signs = nullptr;
    /// true: `signs` points to the shaders' scratch memory, where the signs of a chunk begin at the offset that the
    /// plan gives for the chunk
    bool signs_in_place = false;
  };
  Result<Output> read(const BatchPlan& plan, BatchBuffers& buffers);

  uint32_t maxScratchWords() const;

 private:
  Mesher(Queue& queue, Memory& memory, CommandRing& ring, Kernels& kernels)
      : queue_(queue), memory_(memory), ring_(ring), kernels_(kernels) {}
  Result<void> fit(const BatchPlan& plan, BatchBuffers& buffers);
  Result<void> fitBack(const BatchPlan& plan, BatchBuffers& buffers);
  Result<void> downloadLater(const batch::Head& head, BatchBuffers& buffers);
  Result<void> record(Commands& commands, const Pipelines& pipelines, const BatchPlan& plan, BatchBuffers& buffers);

  Queue& queue_;
  Memory& memory_;
  CommandRing& ring_;
  Kernels& kernels_;
  Buffer tables_;
  /// bytes of vertices and indices of the last batch, with a margin
  std::atomic<uint64_t> usual_vertices_{0}, usual_indices_{0};
};

}  // namespace sgm::vulkan

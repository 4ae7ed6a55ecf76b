#pragma once
// The shaders of shaders/mesher/ on one device: a planned batch in, its parts out.

#include <array>
#include <atomic>
#include <memory>

#include "backend/vulkan/batch_plan.h"
#include "backend/vulkan/commands.h"
#include "backend/vulkan/kernels.h"

namespace sgm::vulkan {

/// The buffers of a batch in flight; reused from batch to batch, and grown where one needs more.
struct BatchBuffers {
  Buffer words, staging, scratch, parts, vertices, indices;
  /// Where the host does not see the device's: what is brought back. The buffers of the batches that are at work in
  /// turn are the ring that results come back through. How many vertices and indices there will be only the device
  /// knows; as many as batches of late have had come back with the batch itself, and only where it has more they come
  /// after it.
  Buffer parts_back, signs_back, vertices_back, indices_back;
  uint64_t brought_vertices = 0, brought_indices = 0;  ///< bytes that come with the batch
  uint64_t reading = 0;  ///< of the queue: vertices and indices are brought to the host until then
};

/// Any thread may use it. Outlived by all that it is given.
class Mesher {
 public:
  /// Errors: as Memory::buffer.
  static Result<std::unique_ptr<Mesher>> create(Queue& queue, Memory& memory, CommandRing& ring, Kernels& kernels);

  /// Submits the batch; the value of the queue that it ends with. The plan and the buffers must stay as they are until
  /// then. Waits for pipelines that are not made yet (Kernels::get). Errors: device_lost,
  /// out_of_memory, limit, unsupported. Throws std::bad_alloc.
  Result<uint64_t> submit(const BatchPlan& plan, BatchBuffers& buffers);

  /// After the end of what was submitted with these two: what the host reads, valid until the next submission. Where
  /// vertices and indices must be brought to the host first it waits for that; where no chunk wants them there are
  /// none. Errors: as submit.
  struct Output {
    const batch::Head* head = nullptr;
    const batch::Part* parts = nullptr;
    const batch::Sums* sums = nullptr;  ///< of the parts of chunks that ask for them
    const Vertex* vertices = nullptr;
    const uint32_t* indices = nullptr;
    const uint32_t* signs = nullptr;  ///< of the plan's chunks behind each other, batch::kSignWords each
    bool signs_in_place = false;      ///< signs is scratch, where each chunk's own place counts
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
  /// Bytes that the last batch had, and some more.
  std::atomic<uint64_t> usual_vertices_{0}, usual_indices_{0};
};

}  // namespace sgm::vulkan

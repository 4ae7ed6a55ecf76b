#pragma once
// The shaders of shaders/mesher/ on one device: a planned batch in, its parts out.

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "backend/vulkan/batch_plan.h"
#include "backend/vulkan/commands.h"
#include "backend/vulkan/pipeline_cache.h"

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

/// Any thread may use it. Outlived by the queue, memory and ring that it is given.
class Mesher {
 public:
  /// Errors: as Pipeline::create and Memory::buffer.
  static Result<std::unique_ptr<Mesher>> create(Queue& queue, Memory& memory, CommandRing& ring,
                                                const PipelineCache* cache);

  /// Submits the batch; the value of the queue that it ends with. The plan and the buffers must stay as they are until
  /// then. Makes pipelines where instructions come up for the first time, which may take seconds. Errors: device_lost,
  /// out_of_memory, limit, unsupported. Throws std::bad_alloc.
  Result<uint64_t> submit(const BatchPlan& plan, BatchBuffers& buffers);

  /// After the end: what the host reads, valid until the next submission with these buffers. Where vertices and indices
  /// must be brought to the host first it waits for that. Errors: as submit.
  struct Output {
    const batch::Head* head = nullptr;
    const batch::Part* parts = nullptr;
    const Vertex* vertices = nullptr;
    const uint32_t* indices = nullptr;
    const uint32_t* signs = nullptr;  ///< of the plan's chunks behind each other, batch::kSignWords each
    bool signs_in_place = false;      ///< signs is scratch, where each chunk's own place counts
  };
  Result<Output> read(BatchBuffers& buffers);

  uint32_t mostScratchWords() const;
  /// Whether pipelines were made since it was asked last.
  bool madePipelines();

 private:
  enum Kernel {
    prune,
    refine,
    fill_signs,
    sample,
    census_body,
    census_seam,
    allocate,
    body_vertices,
    seam_vertices,
    plane_units,
    attributes,
    list_cells,
    triangles,
    seam_triangles,
    kernels
  };
  using Pipelines = std::array<std::shared_ptr<const Pipeline>, kernels>;

  Mesher(Queue& queue, Memory& memory, CommandRing& ring, const PipelineCache* cache)
      : queue_(queue), memory_(memory), ring_(ring), cache_(cache) {}
  Result<std::shared_ptr<const Pipeline>> makePipeline(Kernel kernel, uint64_t kinds) const;
  Result<Pipelines> pipelinesFor(uint64_t kinds);
  Result<void> fit(const BatchPlan& plan, BatchBuffers& buffers);
  Result<void> fitBack(const BatchPlan& plan, BatchBuffers& buffers);
  Result<void> bringLater(const batch::Head& head, BatchBuffers& buffers);
  Result<void> record(Commands& commands, const Pipelines& pipelines, const BatchPlan& plan, BatchBuffers& buffers);
  bool software() const { return queue_.device().info().software(); }
  uint32_t width() const;

  Queue& queue_;
  Memory& memory_;
  CommandRing& ring_;
  const PipelineCache* cache_;
  Buffer tables_;
  std::mutex mutex_;
  uint64_t kinds_ = 0;  ///< what the pipelines know
  bool made_ = false;
  Pipelines pipelines_;
  /// Bytes that the last batch had, and some more.
  std::atomic<uint64_t> usual_vertices_{0}, usual_indices_{0};
};

}  // namespace sgm::vulkan

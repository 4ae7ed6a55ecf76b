#pragma once
// A planned batch through all kernels of one stream, and its parts back.

#include <array>
#include <atomic>
#include <memory>

#include "cuda/batch_plan.h"
#include "cuda/device.h"

namespace sgm::cuda {

/// A stream and the memory of a batch on it; reused from batch to batch, and grown where one needs more.
struct BatchMemory {
  std::unique_ptr<Stream> stream;  ///< outlives the memory below
  Memory staging, input, scratch, result;
  Memory vertices, indices;
  /// What is brought back. How many vertices and indices there will be only the device knows; as many as batches of
  /// late have had come back with the batch itself, and only where it has more they come after it.
  Memory result_back, signs_back, vertices_back, indices_back;
  uint64_t brought_vertices = 0, brought_indices = 0;  ///< bytes that come with the batch
  uint64_t input_bytes = 0, result_bytes = 0;
  /// Of what is copied once the batch has ended: not behind what an engine gave since. Ends before the memory.
  std::unique_ptr<Stream> reading;
};

/// Any thread may use it. Outlived by the device.
///
/// A batch is ten or eleven launches and some copies, given one by one: no CUDA graph. Every batch has other sizes,
/// places and numbers of blocks, so that a graph's nodes would all be set anew each time, which costs the host what a
/// launch does; and what a graph saves on the device, a microsecond or two between kernels, is little beside those of
/// up to 256 chunks. sgm_bench_kernels (tests/bench) shows both on a device.
class Mesher {
 public:
  /// Errors: as Stream's.
  static Result<std::unique_ptr<Mesher>> create(Device& device, const Room& room);

  /// Gives the batch to the memory's stream, which is made where there is none yet. Plan and memory stay as they are
  /// until its end. Errors: as Stream's; part of the batch may run nevertheless.
  Result<void> submit(const Plan& plan, BatchMemory& memory);

  // The steps of submit(), for who repeats or measures them. Errors: as Stream's.
  /// Gives the memory's stream the plan's programs to bring to the device, where they stay for any number of runs.
  Result<Batch> load(const Plan& plan, BatchMemory& memory);
  /// What the kernels find zero at first. Before every run.
  Result<void> clear(const Plan& plan, BatchMemory& memory) const;
  struct Launch {
    Kernel kernel;
    uint32_t blocks;  ///< 0: nothing to do
  };
  using Launches = std::array<Launch, static_cast<size_t>(Kernel::count)>;
  /// Every kernel, in the order in which they run.
  Launches launches(const Batch& batch) const;
  static Result<void> run(Stream& stream, const Launches& launches, const Batch& batch);

  /// The stream of what is copied after the end. Errors: as Stream's.
  Result<Stream*> reading(BatchMemory& memory);
  /// After the end: what the host reads, valid until the next submission. Waits where more must be brought.
  struct Output {
    const Part* parts = nullptr;
    const Sums* sums = nullptr;  ///< one a part, where a chunk asks for them
    const Vertex* vertices = nullptr;
    const uint32_t* indices = nullptr;
    const uint64_t* signs = nullptr;  ///< kRows a chunk
  };
  Result<Output> read(const Plan& plan, BatchMemory& memory);

 private:
  Mesher(Device& device, const Room& room) : device_(device), room_(room) {}
  Result<void> makeTables();
  Batch sized(const Plan& plan) const;
  Result<void> fit(const Plan& plan, BatchMemory& memory, Batch& batch) const;
  Result<void> bring(const Plan& plan, BatchMemory& memory, const Batch& batch) const;
  Result<void> bringRest(const Head& head, BatchMemory& memory);

  Device& device_;
  const Room room_;
  std::unique_ptr<Stream> stream_;  ///< of the tables
  Memory tables_;
  /// Bytes that the last batch had, and some more.
  std::atomic<uint64_t> usual_vertices_{0}, usual_indices_{0};
};

}  // namespace sgm::cuda

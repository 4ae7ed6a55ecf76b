#pragma once
// Runs a planned batch through all kernels in one stream, and downloads its parts.

#include <array>
#include <atomic>
#include <memory>

#include "cuda/batch_plan.h"
#include "cuda/device.h"

namespace sgm::cuda {

/// The stream and the memory of one batch; reused for further batches, and enlarged if necessary.
struct BatchMemory {
  std::unique_ptr<Stream> stream;  ///< must outlive the memory below
  Memory staging, input, scratch, result;
  Memory vertices, indices;
  /// Memory for downloads. The numbers of vertices and indices are known only to the device, so as many as recent
  /// batches had are downloaded with the batch itself; if the batch has more, the rest is downloaded later.
  Memory result_back, signs_back, vertices_back, indices_back;
  /// bytes of vertices and of indices that are downloaded with the batch
  uint64_t brought_vertices = 0, brought_indices = 0;
  uint64_t input_bytes = 0, result_bytes = 0;
  /// The stream for copies after the end of the batch, so that they do not wait for later work of an engine in
  /// `stream`. Destroyed before the memory.
  std::unique_ptr<Stream> reading;
};

/// Thread-safe. The device must outlive it.
///
/// A batch is ten or eleven launches and some copies, issued one by one, without a CUDA graph. Every batch has other
/// sizes, places and numbers of blocks, so all nodes of a graph would have to be set each time, which costs the host as
/// much as a launch. On the device a graph saves a microsecond or two between kernels, which is little compared with
/// the kernels of up to 256 chunks. sgm_bench_kernels (tests/bench) measures both on a device.
class Mesher {
 public:
  /// Errors: those of Stream.
  static Result<std::unique_ptr<Mesher>> create(Device& device, const Room& room);

  /// Submits the batch to the memory's stream, which is created if there is none. Plan and memory must not change until
  /// the batch has ended. Errors: those of Stream; then a part of the batch may run nevertheless.
  Result<void> submit(const Plan& plan, BatchMemory& memory);

  // The following functions are the steps of submit(), for repetition and measurement. Errors: those of Stream.
  /// Uploads the plan's programs; they stay on the device for any number of runs.
  Result<Batch> load(const Plan& plan, BatchMemory& memory);
  /// Clears the memory that kernels expect to be zero. Call it before each run.
  Result<void> clear(const Plan& plan, BatchMemory& memory) const;
  struct Launch {
    Kernel kernel;
    uint32_t blocks;  ///< number of blocks; 0: nothing to do
  };
  using Launches = std::array<Launch, static_cast<size_t>(Kernel::count)>;
  /// Returns all kernels in the order in which they run.
  Launches launches(const Batch& batch) const;
  static Result<void> run(Stream& stream, const Launches& launches, const Batch& batch);

  /// Returns the stream for copies after the end of the batch. Errors: those of Stream.
  Result<Stream*> reading(BatchMemory& memory);
  /// Returns the results in host memory, valid until the next submission. Call after the end of the batch. Waits if
  /// more must be downloaded.
  struct Output {
    const Part* parts = nullptr;
    const Sums* sums = nullptr;  ///< one per part, if a chunk requests sums
    const Vertex* vertices = nullptr;
    const uint32_t* indices = nullptr;
    const uint64_t* signs = nullptr;  ///< kRows per chunk
  };
  Result<Output> read(const Plan& plan, BatchMemory& memory);

 private:
  Mesher(Device& device, const Room& room) : device_(device), room_(room) {}
  Result<void> makeTables();
  Batch sized(const Plan& plan) const;
  Result<void> fit(const Plan& plan, BatchMemory& memory, Batch& batch) const;
  Result<void> download(const Plan& plan, BatchMemory& memory, const Batch& batch) const;
  Result<void> downloadRest(const Head& head, BatchMemory& memory);

  Device& device_;
  const Room room_;
  std::unique_ptr<Stream> stream_;  ///< used to upload the case tables
  Memory tables_;
  /// bytes of vertices and indices of the last batch, with a margin
  std::atomic<uint64_t> usual_vertices_{0}, usual_indices_{0};
};

}  // namespace sgm::cuda

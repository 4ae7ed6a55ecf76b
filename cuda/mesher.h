#pragma once
// Runs a planned batch through all kernels in one stream, and downloads the resulting mesh parts.

#include <array>
#include <atomic>
#include <memory>

#include "cuda/batch_plan.h"
#include "cuda/device.h"

namespace sgm::cuda {

/// The stream and the memory of one batch. It is reused for further batches, and grows if necessary.
struct BatchMemory {
  std::unique_ptr<Stream> stream;  ///< the memory below is allocated in this stream, so the stream must outlive it
  Memory staging, input, scratch, result;
  Memory vertices, indices;
  /// Host memory for downloads. Only the device knows how many vertices and indices a batch has. Therefore the batch
  /// downloads as many as recent batches had; if it has more, they are downloaded after its end.
  Memory result_back, signs_back, vertices_back, indices_back;
  /// numbers of bytes of vertices and of indices that the batch itself downloads
  uint64_t brought_vertices = 0, brought_indices = 0;
  uint64_t input_bytes = 0, result_bytes = 0;
  /// A separate stream for copies after the end of the batch: if `stream` is the engine's, copies in it would wait for
  /// the engine's later work. Destroyed before the memory.
  std::unique_ptr<Stream> reading;
};

/// Runs batches. Thread-safe. The device must outlive it.
///
/// A batch is ten or eleven kernel launches and some copies, issued one by one, without a CUDA graph. Sizes, addresses
/// and block counts differ for every batch, so all nodes of a graph would have to be updated each time, which costs the
/// host as much as the launches. On the device a graph saves one or two microseconds between kernels, which is little
/// compared with the run time of kernels for up to 256 chunks. sgm_bench_kernels (tests/bench) measures both variants.
class Mesher {
 public:
  /// Creates a mesher and uploads the lookup tables. Errors: those of Stream.
  static Result<std::unique_ptr<Mesher>> create(Device& device, const Room& room);

  /// Submits the batch to memory.stream, which is created if it is null. Plan and memory must not change until the
  /// batch has ended. Errors: those of Stream; a part of the batch may run even then.
  Result<void> submit(const Plan& plan, BatchMemory& memory);

  // The functions below are the steps of submit(). They are public so that benchmarks can repeat and measure each step.
  // Errors: those of Stream.

  /// Uploads the plan's arrays; they stay on the device for any number of runs.
  Result<Batch> load(const Plan& plan, BatchMemory& memory);
  /// Zeroes the memory that kernels expect to be zero. Call it before each run.
  Result<void> clear(const Plan& plan, BatchMemory& memory) const;
  struct Launch {
    Kernel kernel;
    uint32_t blocks;  ///< number of thread blocks; 0: the kernel is not launched
  };
  using Launches = std::array<Launch, static_cast<size_t>(Kernel::count)>;
  /// Returns all kernels with their numbers of blocks, in the order of their launches.
  Launches launches(const Batch& batch) const;
  static Result<void> run(Stream& stream, const Launches& launches, const Batch& batch);

  /// Returns memory.reading, the stream for copies after the end of the batch. Errors: those of Stream.
  Result<Stream*> reading(BatchMemory& memory);
  /// The results of a batch in host memory, valid until the next submission with the same memory.
  struct Output {
    const Part* parts = nullptr;
    const Sums* sums = nullptr;  ///< one entry per part; null if no chunk requests sums
    const Vertex* vertices = nullptr;
    const uint32_t* indices = nullptr;
    const uint64_t* signs = nullptr;  ///< sign words, kRows per chunk
  };
  /// Returns the results. Call after the end of the batch. Blocks if more must be downloaded.
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
  std::unique_ptr<Stream> stream_;  ///< the stream that uploads the lookup tables
  Memory tables_;
  /// numbers of bytes of vertices and of indices to download with the next batch: those of the last batch plus a margin
  std::atomic<uint64_t> usual_vertices_{0}, usual_indices_{0};
};

}  // namespace sgm::cuda

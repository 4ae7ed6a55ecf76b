#pragma once
// The interface between the runtime and a device: it receives field programs and returns chunk meshes. All backends
// return the same bytes.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <memory_resource>
#include <span>
#include <string>
#include <vector>

#include "base/jobs.h"
#include "base/result.h"
#include "field/program.h"
#include "mesh/chunk.h"
#include "mesh/fans.h"
#include "mesh/part_sums.h"

namespace sgm {

enum class BackendKind : uint8_t { cpu, vulkan, cuda };

/// Returns the name of a backend in options: "cpu", "vulkan", "cuda".
const char* backendName(BackendKind kind);

struct BackendCapabilities {
  BackendKind kind = BackendKind::cpu;
  std::string device;        ///< name of the device, or of the instruction set in use
  bool exact = true;         ///< true: follows the arithmetic contract, so that results are bit-exact
  uint32_t concurrency = 1;  ///< number of chunks that are processed concurrently
  bool software = false;     ///< true: the CPU emulates the device
  /// true: supports ChunkJob::resident and upload(), because the device is the engine's own
  bool lends_meshes = false;
};

/// A part of a chunk in the memory of a device, for drawing there (vulkan/device_meshes.h). Immutable; any thread may
/// destroy it.
class DevicePart {
 public:
  virtual ~DevicePart() = default;
  virtual BackendKind kind() const = 0;
  /// True if the content is on the device, or will be when the copying ends.
  virtual bool there() const { return true; }
};

inline constexpr size_t kMeshParts = 7;
/// The parts of a chunk on a device: the body, then seams by Face; null for an absent part.
using DeviceParts = std::array<std::shared_ptr<const DevicePart>, kMeshParts>;

/// A chunk to be meshed. The programs must contain every group whose influence box meets the chunk's closed box.
struct ChunkJob {
  ChunkGrid grid;
  std::shared_ptr<const FieldProgram> field;   ///< the field at grid.level
  std::shared_ptr<const FieldProgram> coarse;  ///< the field at grid.level + 1; null if no seam is requested
  uint8_t seams = 0;                           ///< the seams to make: bit (1 << Face)
  /// the blocks around the chunk that have a coarser level; decides only the fans in keys of seams
  Neighbourhood coarser = 0;
  bool signs = false;  ///< also return the signs of the samples
  bool keys = true;    ///< true: return vertex keys (MeshPart::keys); false: the parts may lack them
  bool body = true;    ///< true: mesh the body; false: only seams, and body, signs and counts stay empty
  /// return the sums over the meshes instead of the meshes, which need not be downloaded from a device then
  bool sums_only = false;
  bool resident = false;  ///< also keep vertices and indices on the device, if it is the engine's
  bool prompt = false;    ///< let the CPU mesh the chunk instead of waiting until the device is ready
};

/// The result for a chunk. Parts without triangles are empty, with hash 0.
struct ChunkMesh {
  MeshPart body;
  std::vector<MeshPart> seams;  ///< empty, or six seams by Face
  uint32_t solid_samples = 0;   ///< number of solid samples among the lower 32^3
  uint32_t rounded = 0;         ///< number of loops of the body that lack their sharp features (mesh/features.h)
  bool uniform = false;         ///< proven solid or void without sampling, so that there is no body
  /// In the format of ChunkSamples::signs, if requested and the chunk is not uniform. For a uniform chunk,
  /// solid_samples says whether it is solid.
  std::pmr::vector<uint64_t> signs;
  std::array<PartSums, kMeshParts> sums;  ///< for ChunkJob::sums_only: sums over the body, then over the seams by Face
  /// for ChunkJob::resident: set if the device meshed the parts and had memory for them
  DeviceParts on_device;

  explicit ChunkMesh(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : body(memory), signs(memory) {}
};

/// A batch of jobs that was submitted to a backend. Destroying it cancels jobs that have not begun, and waits for the
/// others.
class ChunkBatch {
 public:
  virtual ~ChunkBatch() = default;
  /// Returns true if all jobs have ended; does not wait for the device. If the job system has its own threads, the
  /// batch progresses without a waiting thread.
  virtual bool poll() = 0;
  /// Returns when all jobs have ended. The calling thread works meanwhile, as one of the job system's workers
  /// (base/jobs.h).
  virtual void wait() = 0;
  /// Cancels jobs that have not begun; they get no mesh. Thread-safe. Work that was submitted to a device cannot be
  /// stopped: it runs to its end, but its meshes are not read.
  virtual void cancel() = 0;
  /// Returns one mesh for each job, in order. Call after the end of all jobs. Errors: out_of_memory; cancelled if a job
  /// did not run. Rethrows other exceptions of jobs.
  virtual Result<std::vector<ChunkMesh>> take() = 0;
};

/// Called after each meshed chunk, before the batch counts the chunk as ended. Called by any thread, also concurrently.
/// Returning false cancels the batch.
using AfterChunk = std::function<bool()>;

/// Counts of a backend's work since its creation.
struct BackendCounters {
  uint64_t chunks = 0;  ///< chunks that ended with a mesh
  /// number of these that the CPU meshed, because the device had no memory for them or was not ready
  uint64_t on_cpu = 0;
  uint64_t device_lost = 0;  ///< number of device failures
  uint64_t batches = 0;      ///< submissions to the device
  uint64_t resident = 0;     ///< size of the parts that are on the device now, in bytes
};

/// Meshes chunks. Thread-safe. Must outlive its batches.
class Backend {
 public:
  virtual ~Backend() = default;
  virtual const BackendCapabilities& capabilities() const = 0;
  virtual BackendCounters counters() const { return {}; }
  virtual Result<std::unique_ptr<ChunkBatch>> submit(std::vector<ChunkJob> jobs, AfterChunk after_chunk = {}) = 0;
  /// The number of chunks per submit() that keeps the backend busy now; 1 while the CPU replaces a device.
  virtual uint32_t batch() const { return 1; }
  /// Uploads parts to the device, with the same result as for ChunkJob::resident; null for a part that has no
  /// triangles, or for which there is no memory. Waits for the device. Errors: unsupported (the device is not the
  /// engine's), out_of_memory, limit, device_lost. Throws std::bad_alloc.
  virtual Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const>) {
    return Error{Code::unsupported, "this backend has no external device"};
  }
};

}  // namespace sgm

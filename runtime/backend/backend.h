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

/// Returns the name of a kind of backend, as in options: "cpu", "vulkan", "cuda".
const char* backendName(BackendKind kind);

struct BackendCapabilities {
  BackendKind kind = BackendKind::cpu;
  std::string device;        ///< name of the device, or of the instruction set in use
  bool exact = true;         ///< true: results are bit-exact, by the arithmetic contract (runtime/README.md)
  uint32_t concurrency = 1;  ///< number of chunks that are processed concurrently
  bool software = false;     ///< true: the CPU emulates the device
  /// true: supports ChunkJob::resident and upload(), because it uses the engine's own device
  bool lends_meshes = false;
};

/// A part of a chunk in the memory of a device, for drawing there (vulkan/device_meshes.h). Immutable; any thread may
/// destroy it.
class DevicePart {
 public:
  virtual ~DevicePart() = default;
  virtual BackendKind kind() const = 0;
  /// True if the content is on the device, or will be when a pending copy ends.
  virtual bool there() const { return true; }
};

inline constexpr size_t kMeshParts = 7;
/// The parts of a chunk on a device: the body, then seams by Face; null for an absent part.
using DeviceParts = std::array<std::shared_ptr<const DevicePart>, kMeshParts>;

/// A chunk to be meshed. The field programs must contain every group of shapes (field/program.h) whose influence box
/// meets the chunk's closed box.
struct ChunkJob {
  ChunkGrid grid;
  std::shared_ptr<const FieldProgram> field;   ///< program of the field at grid.level
  std::shared_ptr<const FieldProgram> coarse;  ///< program of the field at grid.level + 1; null if no seam is requested
  uint8_t seams = 0;                           ///< the seams to make: for each, bit 1 << Face
  /// set of the blocks around the chunk that have a coarser level; affects only VertexKey::fan in seams
  Neighbourhood coarser = 0;
  bool signs = false;  ///< true: also return the signs of the samples
  bool keys = true;    ///< true: return vertex keys (MeshPart::keys); false: parts may come without keys
  bool body = true;    ///< true: mesh the body; false: mesh only seams, and leave body, signs and counts in the result
                       ///< empty
  /// true: return only the sums over the meshes (ChunkMesh::sums), so that a device need not download the meshes
  bool sums_only = false;
  bool resident = false;  ///< true: if the device is the engine's own, also keep vertices and indices on it
  bool prompt = false;    ///< true: let the CPU mesh the chunk instead of waiting until the device is ready
};

/// The result for a chunk. Parts without triangles are empty, with hash 0.
struct ChunkMesh {
  MeshPart body;
  /// one seam for each face of the chunk, indexed by Face; empty if no seam was requested
  std::vector<MeshPart> seams;
  uint32_t solid_samples = 0;  ///< number of solid samples, except those in the chunk's high faces
  uint32_t rounded = 0;        ///< number of loops of the body whose sharp features could not be made (sharpenBody)
  bool uniform = false;        ///< true: the chunk is proven solid or void without sampling, and has no body
  /// Signs of the samples, in the format of ChunkSamples::signs, if requested and the chunk is not uniform. For a
  /// uniform chunk, solid_samples says whether it is solid.
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

/// A function that is called after each meshed chunk, before the batch counts the chunk as ended. Any thread calls it,
/// also concurrently. It returns false to cancel the batch.
using AfterChunk = std::function<bool()>;

/// Counts of a backend's work since its creation.
struct BackendCounters {
  uint64_t chunks = 0;  ///< number of chunks that ended with a mesh
  /// number of chunks that the CPU meshed, because the device had no memory for them or was not ready
  uint64_t on_cpu = 0;
  uint64_t device_lost = 0;  ///< number of device failures
  uint64_t batches = 0;      ///< number of submissions to the device
  uint64_t resident = 0;     ///< size of the parts that are on the device now, in bytes
};

/// Meshes chunks. Thread-safe. Must outlive its batches.
class Backend {
 public:
  virtual ~Backend() = default;
  virtual const BackendCapabilities& capabilities() const = 0;
  virtual BackendCounters counters() const { return {}; }
  virtual Result<std::unique_ptr<ChunkBatch>> submit(std::vector<ChunkJob> jobs, AfterChunk after_chunk = {}) = 0;
  /// The number of chunks per submit() that keeps the backend busy now; 1 while the CPU does the work of a device.
  virtual uint32_t batch() const { return 1; }
  /// Uploads parts to the device, with the same result as for ChunkJob::resident; null for a part that has no
  /// triangles, or for which there is no memory. Waits for the device. Errors: unsupported (the device is not the
  /// engine's), out_of_memory, limit, device_lost. Throws std::bad_alloc.
  virtual Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const>) {
    return Error{Code::unsupported, "this backend has no external device"};
  }
};

}  // namespace sgm

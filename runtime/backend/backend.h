#pragma once
// The interface between the runtime and a device: field programs in, packed chunk meshes out, the same bytes from all.

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

/// The names in options: "cpu", "vulkan", "cuda".
const char* backendName(BackendKind kind);

struct BackendCapabilities {
  BackendKind kind = BackendKind::cpu;
  std::string device;         ///< device name, or the instruction set in use
  bool exact = true;          ///< keeps the arithmetic contract (bit-exact)
  uint32_t concurrency = 1;   ///< number of chunks processed concurrently
  bool software = false;      ///< the device is emulated by the CPU
  bool lends_meshes = false;  ///< supports ChunkJob::resident and upload(): the device is the engine's own
};

/// A part on the device that has meshed it, for drawing there (vulkan/device_meshes.h). Immutable; any thread may
/// destroy it.
class DevicePart {
 public:
  virtual ~DevicePart() = default;
  virtual BackendKind kind() const = 0;
  /// Whether its content is on the device, or will be.
  virtual bool there() const { return true; }
};

inline constexpr size_t kMeshParts = 7;
/// The body, then seams by Face; null for an absent part.
using DeviceParts = std::array<std::shared_ptr<const DevicePart>, kMeshParts>;

/// One chunk to mesh. The programs must hold every group whose influence box meets the chunk's closed box.
struct ChunkJob {
  ChunkGrid grid;
  std::shared_ptr<const FieldProgram> field;   ///< at grid.level
  std::shared_ptr<const FieldProgram> coarse;  ///< at grid.level + 1; null if no seam is requested
  uint8_t seams = 0;                           ///< bit (1 << Face): make this seam
  Neighbourhood coarser = 0;  ///< the surrounding blocks of a coarser level; decides only the fans in seam keys
  bool signs = false;         ///< also give the signs of the samples
  bool keys = true;           ///< false: the parts need no keys (MeshPart::keys), and may be without
  bool body = true;           ///< false: only the seams; body, signs and counts stay empty
  bool sums_only = false;     ///< return the sums over the meshes instead of the meshes, which a device then keeps to
                              ///< itself
  bool resident = false;      ///< also leave vertices and indices on the device, if it is the engine's
  bool prompt = false;        ///< let the CPU mesh it rather than wait until the device is ready
};

/// The result for a chunk. Parts without surface are empty, their hash 0.
struct ChunkMesh {
  MeshPart body;
  std::vector<MeshPart> seams;  ///< none, or six by Face
  uint32_t solid_samples = 0;   ///< solid ones of the lower 32^3 samples
  uint32_t rounded = 0;         ///< loops of cells whose sharp features are missing in the body (mesh/features.h)
  bool uniform = false;         ///< proven without a sample: no body
  /// If requested, and not uniform: as ChunkSamples::signs. For a uniform chunk solid_samples gives the only sign.
  std::pmr::vector<uint64_t> signs;
  std::array<PartSums, kMeshParts> sums;  ///< for ChunkJob::sums_only: the body's, then the seams' by Face
  DeviceParts on_device;                  ///< for ChunkJob::resident, if the device meshed them and has memory

  explicit ChunkMesh(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : body(memory), signs(memory) {}
};

/// Work submitted to a device. Destroying it cancels jobs that have not begun, and waits for the others.
class ChunkBatch {
 public:
  virtual ~ChunkBatch() = default;
  /// Whether all jobs have ended; does not wait for the device. The work progresses without a waiting thread if the job
  /// system has its own threads.
  virtual bool poll() = 0;
  /// Returns when all jobs have ended; the calling thread works, too, as one of the job system's workers (base/jobs.h).
  virtual void wait() = 0;
  /// Jobs that have not begun end without a mesh. Thread-safe. Work submitted to a device cannot be stopped: it runs to
  /// its end, but its meshes are not read.
  virtual void cancel() = 0;
  /// Call after the end: one mesh for each job, in order. Errors: out_of_memory; cancelled if a job did not run.
  /// Rethrows other exceptions of jobs.
  virtual Result<std::vector<ChunkMesh>> take() = 0;
};

/// Called after each meshed chunk, before the batch counts it as ended, on any thread, several concurrently. Returning
/// false cancels the batch.
using AfterChunk = std::function<bool()>;

/// What a backend did since its creation.
struct BackendCounters {
  uint64_t chunks = 0;       ///< chunks that ended with a mesh
  uint64_t on_cpu = 0;       ///< of these, meshed by the CPU: too large for the device, or it was not ready
  uint64_t device_lost = 0;  ///< number of device failures
  uint64_t batches = 0;      ///< submissions to the device
  uint64_t resident = 0;     ///< bytes of parts on the device now
};

/// Thread-safe. Must outlive its batches.
class Backend {
 public:
  virtual ~Backend() = default;
  virtual const BackendCapabilities& capabilities() const = 0;
  virtual BackendCounters counters() const { return {}; }
  virtual Result<std::unique_ptr<ChunkBatch>> submit(std::vector<ChunkJob> jobs, AfterChunk after_chunk = {}) = 0;
  /// The number of chunks in one submit() that keep it busy now: more for a device than for the CPU in its place.
  virtual uint32_t batch() const { return 1; }
  /// Uploads parts to the device, like those of ChunkJob::resident; null for a part without triangles or without room.
  /// Waits for the device. Errors: unsupported (the device is not the engine's), out_of_memory, limit, device_lost.
  /// Throws std::bad_alloc.
  virtual Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const>) {
    return Error{Code::unsupported, "this backend has no external device"};
  }
};

}  // namespace sgm

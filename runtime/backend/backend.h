#pragma once
// The seam between the runtime and a device: field programs in, packed chunk meshes out, the same bytes from every one.

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

/// As users write it: "cpu", "vulkan", "cuda".
const char* backendName(BackendKind kind);

struct BackendCapabilities {
  BackendKind kind = BackendKind::cpu;
  std::string device;         ///< device name, or the instruction set in use
  bool exact = true;          ///< keeps the arithmetic contract
  uint32_t concurrency = 1;   ///< chunks worked on at one time
  bool software = false;      ///< the CPU plays a device's part
  bool lends_meshes = false;  ///< ChunkJob::resident and upload(): the device is the engine's own
};

/// What draws a part on the device that has meshed it (vulkan/device_meshes.h). Immutable; any thread may end it.
class DevicePart {
 public:
  virtual ~DevicePart() = default;
  virtual BackendKind kind() const = 0;
  /// Whether it lies there, or will; of one that was made.
  virtual bool there() const { return true; }
};

inline constexpr size_t kMeshParts = 7;
/// The body, then seams by Face; null where there is none.
using DeviceParts = std::array<std::shared_ptr<const DevicePart>, kMeshParts>;

/// One chunk to mesh. The programs must hold every group whose influence box meets the chunk's closed box.
struct ChunkJob {
  ChunkGrid grid;
  std::shared_ptr<const FieldProgram> field;   ///< at grid.level
  std::shared_ptr<const FieldProgram> coarse;  ///< at grid.level + 1; null where no seam is asked for
  uint8_t seams = 0;                           ///< bit (1 << Face): make this seam
  Neighbourhood coarser = 0;  ///< which blocks around are of a coarser level; decides only the fans in seam keys
  bool signs = false;         ///< also give the signs of the samples
  bool keys = true;           ///< false: the parts need no keys (MeshPart::keys), and may be without
  bool body = true;           ///< false: only the seams; body, signs and counts stay empty
  bool sums_only = false;     ///< give the sums over the meshes, and not the meshes: a device keeps these to itself
  bool resident = false;      ///< also leave vertices and indices on the device, where it is the engine's
  bool prompt = false;        ///< rather by the CPU than wait until the device is ready for work
};

/// What a chunk became. Parts without surface are empty, their hash 0.
struct ChunkMesh {
  MeshPart body;
  std::vector<MeshPart> seams;  ///< none, or six by Face
  uint32_t solid_samples = 0;   ///< solid ones of the lower 32^3 samples
  uint32_t rounded = 0;         ///< loops of cells whose sharp features the body does not have (mesh/features.h)
  bool uniform = false;         ///< proven without a sample: no body
  /// Where asked for and not uniform: as ChunkSamples::signs. Of a uniform chunk solid_samples says the one sign.
  std::pmr::vector<uint64_t> signs;
  std::array<PartSums, kMeshParts> sums;  ///< of ChunkJob::sums_only: the body's, then the seams' by Face
  DeviceParts on_device;  ///< of ChunkJob::resident, as far as the device meshed them and has the memory

  explicit ChunkMesh(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : body(memory), signs(memory) {}
};

/// Work given to a device. Destroying it cancels what has not begun and waits for what has.
class ChunkBatch {
 public:
  virtual ~ChunkBatch() = default;
  /// Whether all jobs have ended; does not wait for the device's work. The work goes on without anyone who waits, where
  /// the job system has threads of its own.
  virtual bool poll() = 0;
  /// Ends when all jobs have; the calling thread works too, as one of the job system's workers (base/jobs.h).
  virtual void wait() = 0;
  /// Jobs that have not begun end without a mesh. Any thread. A device cannot be stopped: what was submitted to it runs
  /// to its end, and only its meshes are not read.
  virtual void cancel() = 0;
  /// After the end: one mesh a job, in order. out_of_memory, or cancelled where a job did not run. What else a job has
  /// thrown is thrown here again.
  virtual Result<std::vector<ChunkMesh>> take() = 0;
};

/// Called after each chunk that was meshed, before the batch counts it as ended; on any thread, several at once. false
/// cancels the batch.
using AfterChunk = std::function<bool()>;

/// What a backend did with the chunks it was given, since it was made.
struct BackendCounters {
  uint64_t chunks = 0;       ///< that have ended with a mesh
  uint64_t on_cpu = 0;       ///< of these, meshed by the CPU instead: too large for the device, or it was not ready
  uint64_t device_lost = 0;  ///< how many times the device failed
  uint64_t batches = 0;      ///< submissions to the device
  uint64_t resident = 0;     ///< bytes of parts that lie on the device now
};

/// Thread-safe. Must outlive its batches.
class Backend {
 public:
  virtual ~Backend() = default;
  virtual const BackendCapabilities& capabilities() const = 0;
  virtual BackendCounters counters() const { return {}; }
  virtual Result<std::unique_ptr<ChunkBatch>> submit(std::vector<ChunkJob> jobs, AfterChunk after_chunk = {}) = 0;
  /// Chunks of one submit() that keep it busy now: a device takes more than the CPU that stands in for it.
  virtual uint32_t batch() const { return 1; }
  /// Brings parts to the device, as ChunkJob::resident leaves them there; null where one has no triangles, or there is
  /// no room for it. Waits for the device. Errors: unsupported (nobody could draw them there), out_of_memory, limit,
  /// device_lost. Throws std::bad_alloc.
  virtual Result<std::vector<std::shared_ptr<const DevicePart>>> upload(std::span<const MeshPart* const>) {
    return Error{Code::unsupported, "this backend has no device that an engine lent"};
  }
};

}  // namespace sgm

#pragma once
// Opens a backend by its kind. No other code knows all kinds.

#include <filesystem>
#include <functional>
#include <memory>
#include <memory_resource>
#include <string>

#include "backend/backend.h"
#include "base/jobs.h"
#include "base/profile.h"
#include "base/result.h"

namespace sgm {

namespace vulkan {
struct BorrowedDevice;
}
namespace cuda {
struct BorrowedContext;
}

struct BackendRequest {
  BackendKind kind = BackendKind::cpu;
  bool automatic = false;  ///< true: ignores kind and chooses CUDA, or else a hardware Vulkan device, or else the CPU
  /// index in the list of devices of its kind; -1: the first usable one (CUDA), or the fastest one (Vulkan)
  int device = -1;
  /// Instruction set of the CPU backend: "scalar", "sse4.2", "avx2", "avx512", "avx512-vbmi2"; empty: the widest that
  /// this processor supports. A device backend also has a CPU backend with this instruction set, for chunks that the
  /// device cannot mesh.
  std::string instruction_set;
  /// Vulkan: the engine's device; null: the backend creates a device. CUDA: the Vulkan device in whose memory meshes
  /// stay, with external_memory set; null: meshes do not stay in the memory of a Vulkan device.
  std::shared_ptr<const vulkan::BorrowedDevice> external = nullptr;
  /// CUDA: the engine's context; null: a new one is used
  std::shared_ptr<const cuda::BorrowedContext> external_context = nullptr;
  std::filesystem::path pipeline_folder = {};  ///< Vulkan: folder of the pipeline cache; empty: not cached
  /// Functions that receive one-line notices about slow work (inform) and about missing features (warn). Called from
  /// any thread; may be null.
  std::function<void(const std::string&)> inform = nullptr, warn = nullptr;
};

/// Opens a backend. jobs and memory must outlive it. Error: unsupported if the backend is not in this build, or not
/// usable on this machine; the message gives the reason.
Result<std::unique_ptr<Backend>> makeBackend(const BackendRequest& request, JobSystem& jobs,
                                             std::pmr::memory_resource* memory, const Profiler& profiler = {});

}  // namespace sgm

#pragma once
// Opens a backend by its kind: the only code that knows all of them.

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
  bool automatic = false;  ///< kind is ignored: CUDA, then a hardware Vulkan device, then the CPU
  int device = -1;         ///< index in the list of its kind; -1: the first, or fastest, usable one
  /// CPU: "scalar", "sse4.2", "avx2", "avx512", "avx512-vbmi2"; empty: the widest that this processor supports.
  std::string instruction_set;
  std::shared_ptr<const vulkan::BorrowedDevice> lent =
      nullptr;  ///< Vulkan: the engine's device; null: create one. CUDA: the device where meshes stay, with
                ///< external_memory; or null
  std::shared_ptr<const cuda::BorrowedContext> lent_context = nullptr;  ///< CUDA: same as above
  std::filesystem::path pipeline_folder = {};  ///< Vulkan: folder of the pipeline cache, or empty
  /// Receive one-line notices about slow work and about missing features. Any thread; may be null.
  std::function<void(const std::string&)> inform = nullptr, warn = nullptr;
};

/// jobs and memory must outlive the backend. unsupported: not built or not usable here; the message gives the reason.
Result<std::unique_ptr<Backend>> makeBackend(const BackendRequest& request, JobSystem& jobs,
                                             std::pmr::memory_resource* memory, const Profiler& profiler = {});

}  // namespace sgm

#pragma once
// Opens a backend by its kind: the one place that knows all of them.

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
  int device = -1;  ///< of its kind, in the order in which they are listed; -1: the first, or fastest, that can be used
  /// CPU: "scalar", "sse4.2", "avx2", "avx512", "avx512-vbmi2"; empty: the widest that runs here.
  std::string instruction_set;
  std::shared_ptr<const vulkan::BorrowedDevice> lent =
      nullptr;  ///< Vulkan: the engine's; null: one of our own. CUDA: where meshes stay, lent with external_memory; or
                ///< null
  std::shared_ptr<const cuda::BorrowedContext> lent_context = nullptr;  ///< CUDA: likewise
  std::filesystem::path pipeline_folder = {};  ///< Vulkan: where compiled pipelines are kept from run to run, or empty
  /// Told, in one line, what took long and what the backend goes on without. Any thread; null: nobody is.
  std::function<void(const std::string&)> inform = nullptr, warn = nullptr;
};

/// jobs and memory must outlive the backend. unsupported: not built or not usable here, and why.
Result<std::unique_ptr<Backend>> makeBackend(const BackendRequest& request, JobSystem& jobs,
                                             std::pmr::memory_resource* memory, const Profiler& profiler = {});

}  // namespace sgm

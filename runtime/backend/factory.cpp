#include "backend/backend.h"
#include "backend/cpu/cpu_backend.h"

namespace sgm {

const char* backendName(BackendKind kind) {
  switch (kind) {
    case BackendKind::cpu:
      return "cpu";
    case BackendKind::vulkan:
      return "vulkan";
    case BackendKind::cuda:
      return "cuda";
  }
  return "";
}

Result<std::unique_ptr<Backend>> makeBackend(const BackendRequest& request, JobSystem& jobs,
                                             std::pmr::memory_resource* memory, const Profiler& profiler) {
  if (!request.automatic && request.kind == BackendKind::vulkan) {
    return Error{Code::unsupported, "this build meshes on the CPU only: it has no Vulkan backend"};
  }
  if (!request.automatic && request.kind == BackendKind::cuda) {
    return Error{Code::unsupported, "this build meshes on the CPU only: it has no CUDA backend"};
  }
  return makeCpuBackend(request.instruction_set, jobs, memory, profiler);
}

}  // namespace sgm

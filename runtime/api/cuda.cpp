#include "sgm/sgm_cuda.h"

#include "api/backend_request.h"
#include "api/barrier.h"
#include "api/mesh.h"
#include "api/runtime.h"
#include "cuda/driver_device.h"
#include "cuda/kept_meshes.h"

using namespace sgm::api;

namespace {

sgm::cuda::BorrowedContext contextOf(const sgm_cuda_device_desc& desc) {
  sgm::cuda::BorrowedContext external;
  external.context = reinterpret_cast<sgm::cuda::CuContext>(desc.context);
  external.stream = reinterpret_cast<sgm::cuda::CuStream>(desc.stream);
  if (desc.mesh_bytes != 0) external.mesh_bytes = desc.mesh_bytes;
  return external;
}

sgm_cuda_part partOf(const sgm::cuda::CudaPart& part) {
  return {reinterpret_cast<uintptr_t>(part.vertices), reinterpret_cast<uintptr_t>(part.indices), part.vertex_count,
          part.index_count};
}

}  // namespace

sgm_result sgm_runtime_lend_cuda(sgm_runtime* runtime, const sgm_cuda_device_desc* desc, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (runtime == nullptr) return nullArgument(error, "runtime");
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    if (desc->context == nullptr) return nullArgument(error, "desc.context");
    constexpr uintptr_t kPerThread = 2;  // value of the special stream handle CU_STREAM_PER_THREAD
    if (reinterpret_cast<uintptr_t>(desc->stream) == kPerThread) {
      return fail(error, SGM_ERR_INVALID_ARGUMENT,
                  "desc.stream is CU_STREAM_PER_THREAD, which is another stream on every thread: pass a stream of "
                  "your own, CU_STREAM_LEGACY or NULL");
    }
    const sgm::Result<void> external =
        lendCuda(*runtime, std::make_shared<const sgm::cuda::BorrowedContext>(contextOf(*desc)));
    return external ? SGM_OK : fail(error, external.error());
  });
}

sgm_result sgm_mesh_get_cuda_view(const sgm_mesh* mesh, sgm_cuda_mesh_view* view, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (mesh == nullptr) return nullArgument(error, "mesh");
    if (sgm_result r = checkDesc(error, view, "view"); r != SGM_OK) return r;
    sgm_cuda_mesh_view found = SGM_CUDA_MESH_VIEW_INIT;
    const sgm::ChunkSurface& surface = *mesh->surface;
    for (size_t p = 0; p < surface.on_device.size(); ++p) {
      if (surface.mesh.ranges[p].index_count == 0) continue;
      const sgm::DevicePart* part = surface.on_device[p].get();
      if (part == nullptr || part->kind() != sgm::BackendKind::cuda) {
        return fail(
            error, SGM_ERR_NOT_FOUND,
            "the mesh is not in the external CUDA context: the world is not SGM_WORLD_RESIDENT, or the GPU's memory "
            "(sgm_cuda_device_desc.mesh_bytes) is used up, or the context was lost earlier; upload the data of "
            "sgm_mesh_get_view");
      }
      const auto& placed = static_cast<const sgm::cuda::CudaPart&>(*part);
      if (placed.memory->meshes().device().lost()) {
        return fail(error, SGM_ERR_DEVICE_LOST, "the CUDA context was lost, and the mesh with it");
      }
      (p == 0 ? found.body : found.seams[p - 1]) = partOf(placed);
    }
    *view = found;
    return SGM_OK;
  });
}

#include "backend/open/open_backend.h"

#include <utility>

#include "backend/cpu/cpu_backend.h"
#include "cuda/cuda_backend.h"
#include "cuda/driver_device.h"
#ifdef SGM_VULKAN
#include "backend/vulkan/shared_meshes.h"
#include "backend/vulkan/vulkan_backend.h"
#endif

namespace sgm {

namespace {

#ifdef SGM_VULKAN
/// Opens the Vulkan backend. software: also accepts a device that the CPU emulates.
Result<std::unique_ptr<Backend>> makeVulkan(const BackendRequest& request, bool software, JobSystem& jobs,
                                            std::pmr::memory_resource* memory, const Profiler& profiler) {
  Result<std::unique_ptr<Backend>> cpu = makeCpuBackend(request.instruction_set, jobs, memory, profiler);
  if (!cpu) return cpu.error();
  VulkanBackendOptions options;
  options.open = [index = request.device, software] {
    vulkan::OwnDevice device;
    device.index = index;
    device.software = software;
    return vulkan::Device::open(device);
  };
  if (request.external) {
    options.resident_cap = request.external->resident_cap;
    options.open = [external = request.external,
                    opened = std::make_shared<bool>(false)]() -> Result<std::unique_ptr<vulkan::Device>> {
      if (std::exchange(*opened, true)) return Error{Code::device_lost, "the engine's Vulkan device was lost"};
      return vulkan::Device::borrow(*external);
    };
  }
  options.pipeline_folder = request.pipeline_folder;
  options.inform = request.inform;
  options.warn = request.warn;
  return makeVulkanBackend(options, std::move(*cpu), memory, profiler);
}

Result<std::shared_ptr<MeshStore>> openStore(const vulkan::BorrowedDevice& drawing) {
  return vulkan::openSharedMeshes(drawing);
}
#else
Result<std::unique_ptr<Backend>> makeVulkan(const BackendRequest&, bool, JobSystem&, std::pmr::memory_resource*,
                                            const Profiler&) {
  return Error{Code::unsupported, "this build has no Vulkan backend: build it with SGM_VULKAN=ON"};
}

Result<std::shared_ptr<MeshStore>> openStore(const vulkan::BorrowedDevice&) {
  return Error{Code::unsupported, "this build has no Vulkan backend: build it with SGM_VULKAN=ON"};
}
#endif

Result<std::unique_ptr<Backend>> makeCuda(const BackendRequest& request, JobSystem& jobs,
                                          std::pmr::memory_resource* memory, const Profiler& profiler) {
  if (cuda::kernelImage().empty()) {
    return Error{Code::unsupported, "this build has no CUDA kernels: build it with nvcc installed and SGM_CUDA=ON"};
  }
  const Result<cuda::DriverTable> driver = cuda::openDriver();
  if (!driver) return driver.error();
  Result<std::unique_ptr<Backend>> cpu = makeCpuBackend(request.instruction_set, jobs, memory, profiler);
  if (!cpu) return cpu.error();
  CudaBackendOptions options;
  int device = request.device;
  if (request.external) {
    Result<std::shared_ptr<MeshStore>> store = openStore(*request.external);
    if (!store) return store.error();
    const Result<int> found = cuda::findDevice(*driver, (*store)->device());
    if (!found) return found.error();
    device = *found;
    options.store = std::move(*store);
  }
  options.open = [table = *driver, external = request.external_context, index = device,
                  opened = std::make_shared<bool>(false)]() -> Result<std::unique_ptr<cuda::Device>> {
    if (!external) return cuda::openDevice(table, cuda::kernelImage(), index);
    // The engine's context is opened only once. If a lost context were opened again, meshes that were lost with it
    // would still count as present on the device.
    if (std::exchange(*opened, true)) return Error{Code::device_lost, "the engine's CUDA context was lost"};
    return cuda::borrowDevice(table, cuda::kernelImage(), *external);
  };
  if (request.external_context) options.resident_cap = request.external_context->mesh_bytes;
  options.warn = request.warn;
  return makeCudaBackend(options, std::move(*cpu), memory, profiler);
}

}  // namespace

Result<std::unique_ptr<Backend>> makeBackend(const BackendRequest& request, JobSystem& jobs,
                                             std::pmr::memory_resource* memory, const Profiler& profiler) {
  if (request.automatic) {
    Result<std::unique_ptr<Backend>> cuda = makeCuda(request, jobs, memory, profiler);
    if (cuda) return cuda;
    // Tells users with an NVIDIA GPU why CUDA is not used.
    if (request.inform && !cuda::kernelImage().empty() && cuda::haveDriver()) {
      request.inform("backend auto skips CUDA: " + cuda.error().message);
    }
    if (Result<std::unique_ptr<Backend>> hardware = makeVulkan(request, false, jobs, memory, profiler)) return hardware;
    return makeCpuBackend(request.instruction_set, jobs, memory, profiler);
  }
  if (request.kind == BackendKind::vulkan) return makeVulkan(request, true, jobs, memory, profiler);
  if (request.kind == BackendKind::cuda) return makeCuda(request, jobs, memory, profiler);
  return makeCpuBackend(request.instruction_set, jobs, memory, profiler);
}

}  // namespace sgm

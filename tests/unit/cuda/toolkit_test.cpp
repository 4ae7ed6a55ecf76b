// Tests driver_api.h against the CUDA toolkit's own header and library; also tests the embedded image of the kernels.

#include <cuda.h>
#include <dlfcn.h>

#include <cstddef>
#include <cstring>

#include "catch.h"
#include "cuda/driver_device.h"

using namespace sgm::cuda;

static_assert(kCuSuccess == CUDA_SUCCESS && kCuOutOfMemory == CUDA_ERROR_OUT_OF_MEMORY);
static_assert(kCuDriverMismatch == CUDA_ERROR_SYSTEM_DRIVER_MISMATCH && kCuNoDevice == CUDA_ERROR_NO_DEVICE);
static_assert(kCuNoBinary == CUDA_ERROR_NO_BINARY_FOR_GPU && kCuNotReady == CUDA_ERROR_NOT_READY);
static_assert(kCuUnknownPtx == CUDA_ERROR_UNSUPPORTED_PTX_VERSION);
static_assert(kCuClock == CU_DEVICE_ATTRIBUTE_CLOCK_RATE);
static_assert(kCuProcessors == CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT);
static_assert(kCuCapabilityMajor == CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MAJOR);
static_assert(kCuCapabilityMinor == CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MINOR);
static_assert(kCuMemoryPools == CU_DEVICE_ATTRIBUTE_MEMORY_POOLS_SUPPORTED);
static_assert(kCuPoolThreshold == CU_MEMPOOL_ATTR_RELEASE_THRESHOLD);
static_assert(kCuEventBlocks == CU_EVENT_BLOCKING_SYNC && kCuEventUntimed == CU_EVENT_DISABLE_TIMING);
static_assert(sizeof(CuEvent) == sizeof(CUevent));
static_assert(kCuNonBlockingStream == CU_STREAM_NON_BLOCKING && kCuBlockingWaits == CU_CTX_SCHED_BLOCKING_SYNC);
static_assert(sizeof(CuResult) == sizeof(CUresult) && sizeof(CuDevice) == sizeof(CUdevice));
static_assert(sizeof(CuPoolProperties) == sizeof(CUmemPoolProps));
static_assert(offsetof(CuPoolProperties, location) == offsetof(CUmemPoolProps, location.id));
static_assert(offsetof(CuPoolProperties, max_bytes) == offsetof(CUmemPoolProps, maxSize));
static_assert(CuPoolProperties{}.allocation_type == CU_MEM_ALLOCATION_TYPE_PINNED);
static_assert(CuPoolProperties{}.location_type == CU_MEM_LOCATION_TYPE_DEVICE);
static_assert(sizeof(CuId) == sizeof(CUuuid));
static_assert(CuSharedMemory{}.type == CU_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD);
static_assert(kCuDedicatedMemory == CUDA_EXTERNAL_MEMORY_DEDICATED);
static_assert(sizeof(CuSharedMemory) == sizeof(CUDA_EXTERNAL_MEMORY_HANDLE_DESC));
static_assert(offsetof(CuSharedMemory, handle) == offsetof(CUDA_EXTERNAL_MEMORY_HANDLE_DESC, handle));
static_assert(offsetof(CuSharedMemory, bytes) == offsetof(CUDA_EXTERNAL_MEMORY_HANDLE_DESC, size));
static_assert(offsetof(CuSharedMemory, flags) == offsetof(CUDA_EXTERNAL_MEMORY_HANDLE_DESC, flags));
static_assert(sizeof(CuSharedRange) == sizeof(CUDA_EXTERNAL_MEMORY_BUFFER_DESC));
static_assert(offsetof(CuSharedRange, bytes) == offsetof(CUDA_EXTERNAL_MEMORY_BUFFER_DESC, size));
static_assert(offsetof(CuSharedRange, flags) == offsetof(CUDA_EXTERNAL_MEMORY_BUFFER_DESC, flags));
static_assert(sizeof(CuPointer) == sizeof(CUdeviceptr) && sizeof(CuContext) == sizeof(CUcontext));

TEST_CASE("the driver has every function that is looked up, by that name", "[cuda]") {
  void* const library = dlopen(SGM_CUDA_STUB, RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) {
    WARN("the toolkit has no library to look into: " SGM_CUDA_STUB);
    return;
  }
#define SGM_CU(entry, name, parameters)     \
  {                                         \
    INFO(name);                             \
    CHECK(dlsym(library, name) != nullptr); \
  }
  SGM_CU_FUNCTIONS
#undef SGM_CU
  dlclose(library);
}

TEST_CASE("the library holds the kernels' image, with every kernel in it", "[cuda]") {
  const std::span<const std::byte> image = kernelImage();
  REQUIRE(image.size() > 100'000);
  uint32_t magic = 0;
  std::memcpy(&magic, image.data(), sizeof magic);
  CHECK(magic == 0xBA55ED50u);  // the magic number of a fat binary
}

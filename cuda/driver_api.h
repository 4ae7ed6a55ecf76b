#pragma once
// Declarations of the part of the CUDA driver API that the library uses. The driver is loaded at run time: the library
// works without a driver, and can be built without the toolkit. Types and constants are those of cuda.h
// (tests/unit/cuda/toolkit_test.cpp compares them).

#include <cstddef>
#include <cstdint>

namespace sgm::cuda {

using CuResult = int;
using CuDevice = int;
using CuPointer = unsigned long long;
struct CuContextTag;
struct CuModuleTag;
struct CuFunctionTag;
struct CuStreamTag;
struct CuEventTag;
struct CuPoolTag;
struct CuImportedTag;
using CuContext = CuContextTag*;
using CuModule = CuModuleTag*;
using CuFunction = CuFunctionTag*;
using CuStream = CuStreamTag*;
using CuEvent = CuEventTag*;
using CuPool = CuPoolTag*;
using CuImported = CuImportedTag*;  ///< CUexternalMemory

/// CUmemPoolProps.
struct CuPoolProperties {
  int allocation_type = 1;  ///< CU_MEM_ALLOCATION_TYPE_PINNED, the only type of pools
  int handle_types = 0;
  int location_type = 1;  ///< CU_MEM_LOCATION_TYPE_DEVICE: the memory is on a device
  int location = 0;       ///< number of the device that has the memory
  void* security = nullptr;
  size_t max_bytes = 0;  ///< maximum size of the pool in bytes; 0: the system chooses
  unsigned char reserved[56] = {};
};

/// Same layout as CUDA_EXTERNAL_MEMORY_HANDLE_DESC.
struct CuSharedMemory {
  int type = 1;  ///< CU_EXTERNAL_MEMORY_HANDLE_TYPE_OPAQUE_FD: a file descriptor, which the driver owns after the
                 ///< import
  union {
    int descriptor;
    void* names[2];
  } handle = {};
  unsigned long long bytes = 0;
  unsigned flags = 0;
  unsigned reserved[16] = {};
};
inline constexpr unsigned kCuDedicatedMemory = 1;

/// Same layout as CUDA_EXTERNAL_MEMORY_BUFFER_DESC.
struct CuSharedRange {
  unsigned long long offset = 0, bytes = 0;
  unsigned flags = 0;
  unsigned reserved[16] = {};
};

/// CUuuid.
struct CuId {
  unsigned char bytes[16];
};

inline constexpr CuResult kCuSuccess = 0, kCuOutOfMemory = 2, kCuNoDevice = 100, kCuNoBinary = 209, kCuUnknownPtx = 222,
                          kCuNotReady = 600, kCuDriverMismatch = 803;
inline constexpr int kCuClock = 13, kCuProcessors = 16, kCuCapabilityMajor = 75, kCuCapabilityMinor = 76,
                     kCuMemoryPools = 115;
/// attribute of a memory pool: number of free bytes that it keeps rather than returning them to the system
inline constexpr int kCuPoolThreshold = 4;
inline constexpr unsigned kCuNonBlockingStream = 1;
/// context flag: waiting threads sleep rather than spin, since the engine needs the processors
inline constexpr unsigned kCuBlockingWaits = 4;
inline constexpr unsigned kCuEventBlocks = 1;  ///< event flag: threads that wait for the event sleep rather than spin
inline constexpr unsigned kCuEventUntimed = 2;

/// The functions that are loaded from the driver: SGM_CU(member of DriverTable, symbol name in the driver, parameters)
#define SGM_CU_FUNCTIONS                                                                                           \
  SGM_CU(init, "cuInit", (unsigned flags))                                                                         \
  SGM_CU(driverGetVersion, "cuDriverGetVersion", (int* version))                                                   \
  SGM_CU(getErrorString, "cuGetErrorString", (CuResult result, const char** text))                                 \
  SGM_CU(deviceGetCount, "cuDeviceGetCount", (int* count))                                                         \
  SGM_CU(deviceGet, "cuDeviceGet", (CuDevice * device, int number))                                                \
  SGM_CU(deviceGetName, "cuDeviceGetName", (char* name, int size, CuDevice device))                                \
  SGM_CU(deviceGetAttribute, "cuDeviceGetAttribute", (int* value, int attribute, CuDevice device))                 \
  SGM_CU(deviceTotalMem, "cuDeviceTotalMem_v2", (size_t * bytes, CuDevice device))                                 \
  SGM_CU(deviceGetUuid, "cuDeviceGetUuid", (CuId * id, CuDevice device))                                           \
  SGM_CU(ctxCreate, "cuCtxCreate_v2", (CuContext * context, unsigned flags, CuDevice device))                      \
  SGM_CU(ctxDestroy, "cuCtxDestroy_v2", (CuContext context))                                                       \
  SGM_CU(ctxGetDevice, "cuCtxGetDevice", (CuDevice * device))                                                      \
  SGM_CU(ctxPushCurrent, "cuCtxPushCurrent_v2", (CuContext context))                                               \
  SGM_CU(ctxPopCurrent, "cuCtxPopCurrent_v2", (CuContext * context))                                               \
  SGM_CU(moduleLoadData, "cuModuleLoadData", (CuModule * module, const void* image))                               \
  SGM_CU(moduleUnload, "cuModuleUnload", (CuModule module))                                                        \
  SGM_CU(moduleGetFunction, "cuModuleGetFunction", (CuFunction * function, CuModule module, const char* name))     \
  SGM_CU(streamCreate, "cuStreamCreate", (CuStream * stream, unsigned flags))                                      \
  SGM_CU(streamDestroy, "cuStreamDestroy_v2", (CuStream stream))                                                   \
  SGM_CU(streamGetCtx, "cuStreamGetCtx", (CuStream stream, CuContext * context))                                   \
  SGM_CU(eventCreate, "cuEventCreate", (CuEvent * event, unsigned flags))                                          \
  SGM_CU(eventDestroy, "cuEventDestroy_v2", (CuEvent event))                                                       \
  SGM_CU(eventRecord, "cuEventRecord", (CuEvent event, CuStream stream))                                           \
  SGM_CU(eventQuery, "cuEventQuery", (CuEvent event))                                                              \
  SGM_CU(eventSynchronize, "cuEventSynchronize", (CuEvent event))                                                  \
  SGM_CU(memPoolCreate, "cuMemPoolCreate", (CuPool * pool, const CuPoolProperties* properties))                    \
  SGM_CU(memPoolSetAttribute, "cuMemPoolSetAttribute", (CuPool pool, int attribute, void* value))                  \
  SGM_CU(memPoolDestroy, "cuMemPoolDestroy", (CuPool pool))                                                        \
  SGM_CU(memAllocFromPoolAsync, "cuMemAllocFromPoolAsync",                                                         \
         (CuPointer * memory, size_t bytes, CuPool pool, CuStream stream))                                         \
  SGM_CU(memFreeAsync, "cuMemFreeAsync", (CuPointer memory, CuStream stream))                                      \
  SGM_CU(importExternalMemory, "cuImportExternalMemory", (CuImported * imported, const CuSharedMemory* memory))    \
  SGM_CU(externalMemoryGetMappedBuffer, "cuExternalMemoryGetMappedBuffer",                                         \
         (CuPointer * memory, CuImported imported, const CuSharedRange* range))                                    \
  SGM_CU(destroyExternalMemory, "cuDestroyExternalMemory", (CuImported imported))                                  \
  SGM_CU(memFree, "cuMemFree_v2", (CuPointer memory))                                                              \
  SGM_CU(memHostAlloc, "cuMemHostAlloc", (void** memory, size_t bytes, unsigned flags))                            \
  SGM_CU(memFreeHost, "cuMemFreeHost", (void* memory))                                                             \
  SGM_CU(memcpyHtoDAsync, "cuMemcpyHtoDAsync_v2", (CuPointer to, const void* from, size_t bytes, CuStream stream)) \
  SGM_CU(memcpyDtoHAsync, "cuMemcpyDtoHAsync_v2", (void* to, CuPointer from, size_t bytes, CuStream stream))       \
  SGM_CU(memcpyDtoDAsync, "cuMemcpyDtoDAsync_v2", (CuPointer to, CuPointer from, size_t bytes, CuStream stream))   \
  SGM_CU(memsetD8Async, "cuMemsetD8Async", (CuPointer at, unsigned char value, size_t bytes, CuStream stream))     \
  SGM_CU(launchKernel, "cuLaunchKernel",                                                                           \
         (CuFunction function, unsigned blocks_x, unsigned blocks_y, unsigned blocks_z, unsigned threads_x,        \
          unsigned threads_y, unsigned threads_z, unsigned shared_bytes, CuStream stream, void** parameters,       \
          void** extra))

struct DriverTable {
#define SGM_CU(entry, name, parameters) CuResult(*entry) parameters = nullptr;
  SGM_CU_FUNCTIONS
#undef SGM_CU
};

}  // namespace sgm::cuda

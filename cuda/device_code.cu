// Runs the kernels on the GPU: each thread of a kernels/block.h block is a CUDA thread, and __syncthreads() ends each
// phase.

#include <cub/block/block_scan.cuh>

#include "cuda/kernels/kernels.h"

namespace sgm::cuda {
namespace {

template <uint32_t kThreads>
class DeviceBlock {
 public:
  __device__ uint32_t number() const { return blockIdx.x; }
  __device__ uint32_t count() const { return gridDim.x; }

  template <class Phase>
  __device__ void each(const Phase& phase) const {
    phase(threadIdx.x);
    __syncthreads();
  }

  /// Exclusive prefix sum: replaces each value by the sum of all values before it; returns the sum of all values.
  __device__ uint32_t scan(uint32_t* values, uint32_t count) const {
    using Scan = cub::BlockScan<uint32_t, kThreads>;
    __shared__ typename Scan::TempStorage storage;
    uint32_t sum = 0;
    for (uint32_t first = 0; first < count; first += kThreads) {
      const uint32_t at = first + threadIdx.x;
      uint32_t before = 0, all = 0;
      Scan(storage).ExclusiveSum(at < count ? values[at] : 0, before, all);
      __syncthreads();
      if (at < count) values[at] = sum + before;
      sum += all;
    }
    __syncthreads();
    return sum;
  }
};

}  // namespace
}  // namespace sgm::cuda

#define SGM_CUDA_KERNEL(Name)                                                                                       \
  extern "C" __global__ void __launch_bounds__(sgm::cuda::Name::kThreads) sgm##Name(const sgm::cuda::Batch batch) { \
    __shared__ sgm::cuda::Name::Shared shared;                                                                      \
    const sgm::cuda::DeviceBlock<sgm::cuda::Name::kThreads> block;                                                  \
    sgm::cuda::Name::run(block, batch, shared);                                                                     \
  }
SGM_CUDA_KERNELS

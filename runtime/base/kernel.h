#pragma once
// Marks functions that also run on a GPU.

#ifdef __CUDACC__
#define SGM_KERNEL __host__ __device__ inline
#else
#define SGM_KERNEL inline
#endif

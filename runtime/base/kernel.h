#pragma once
// Macros that mark functions compiled for both CPU and GPU.

#ifdef __CUDACC__
#define SGM_KERNEL __host__ __device__ inline
#else
#define SGM_KERNEL inline
#endif

#pragma once
// All kernels, in the order in which a batch launches them.

#include "cuda/kernels/census.h"
#include "cuda/kernels/emit_body.h"
#include "cuda/kernels/emit_seam.h"
#include "cuda/kernels/prune.h"
#include "cuda/kernels/sample.h"
#include "cuda/kernels/sums.h"

/// The list of kernels: SGM_CUDA_KERNEL(class of the kernel)
#define SGM_CUDA_KERNELS         \
  SGM_CUDA_KERNEL(Prune)         \
  SGM_CUDA_KERNEL(Sample)        \
  SGM_CUDA_KERNEL(CensusBody)    \
  SGM_CUDA_KERNEL(CensusSeam)    \
  SGM_CUDA_KERNEL(Allocate)      \
  SGM_CUDA_KERNEL(BodyVertices)  \
  SGM_CUDA_KERNEL(SeamVertices)  \
  SGM_CUDA_KERNEL(ListCells)     \
  SGM_CUDA_KERNEL(BodyTriangles) \
  SGM_CUDA_KERNEL(SeamTriangles) \
  SGM_CUDA_KERNEL(SumTriangles)

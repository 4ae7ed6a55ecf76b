#pragma once
// Marching cubes over a caller's grid of floats of any size. The grid is quantised, triangulated and welded like
// chunks; normals are those of the grid's gradient.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>

#include "backend/cpu/extract/mesh_kernels.h"
#include "base/jobs.h"
#include "base/raw_array.h"
#include "base/result.h"

namespace sgm::api {

/// A grid owned by the caller. Precondition: the checks of sgm_grid_desc succeeded.
struct GridSamples {
  const float* values = nullptr;
  std::array<size_t, 3> size{};       ///< number of samples on each axis
  size_t stride_y = 0, stride_z = 0;  ///< distance of successive rows and planes, in floats
  double cell = 1;
  bool normals = true;
};

struct GridMesh {
  RawArray<float> positions, normals;               ///< three floats per vertex
  RawArray<uint32_t> indices;                       ///< three per triangle
  std::array<float, 3> bounds_min{}, bounds_max{};  ///< bounding box of the positions; 0 if there is no vertex

  explicit GridMesh(std::pmr::memory_resource* memory) : positions(memory), normals(memory), indices(memory) {}
};

/// Meshes a grid. Vertices and triangles have the order of mesh/body.h, regardless of the job system. A vertex lies at
/// a multiple of 1/256 of its edge; its normal is interpolated between the gradients at the two ends of the edge.
/// Errors: invalid_argument if a value is not finite; limit if the mesh needs more than 2^32 - 1 vertices or indices.
Result<GridMesh> meshGrid(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory,
                          const MeshKernels& kernels = bestMeshKernels());

}  // namespace sgm::api

#pragma once
// Marching cubes on a caller's grid of floats of any size. The samples are quantised, and the mesh is triangulated and
// welded, in the same way as chunks; normals come from the grid's gradient.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>

#include "backend/cpu/extract/mesh_kernels.h"
#include "base/jobs.h"
#include "base/raw_array.h"
#include "base/result.h"

namespace sgm::api {

/// A grid of samples that the caller owns. Precondition: the values of sgm_grid_desc were checked.
struct GridSamples {
  const float* values = nullptr;
  std::array<size_t, 3> size{};       ///< number of samples along each axis
  size_t stride_y = 0, stride_z = 0;  ///< distance between successive rows and planes, in floats
  double cell = 1;
  bool normals = true;
};

struct GridMesh {
  RawArray<float> positions, normals;               ///< three floats per vertex
  RawArray<uint32_t> indices;                       ///< three vertex indices per triangle
  std::array<float, 3> bounds_min{}, bounds_max{};  ///< bounding box of the positions; 0 if there is no vertex

  explicit GridMesh(std::pmr::memory_resource* memory) : positions(memory), normals(memory), indices(memory) {}
};

/// Meshes a grid. The order of vertices and triangles is that of mesh/body.h, regardless of the job system. Vertices
/// lie on grid edges, at multiples of 1/256 of the edge; a normal is interpolated between the gradients at the two ends
/// of the edge. Errors: invalid_argument if a value is not finite; limit if the mesh needs more than 2^32 - 1 vertices
/// or indices.
Result<GridMesh> meshGrid(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory,
                          const MeshKernels& kernels = bestMeshKernels());

}  // namespace sgm::api

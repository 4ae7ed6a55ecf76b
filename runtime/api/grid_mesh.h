#pragma once
// Marching cubes over a caller's grid of floats, of any size: quantised, triangulated and welded as chunks are, with
// normals from the grid's own gradient.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>

#include "backend/cpu/extract/mesh_kernels.h"
#include "base/jobs.h"
#include "base/raw_array.h"
#include "base/result.h"

namespace sgm::api {

/// A grid that the caller owns; the checks of sgm_grid_desc have been made.
struct GridSamples {
  const float* values = nullptr;
  std::array<size_t, 3> size{};       ///< samples
  size_t stride_y = 0, stride_z = 0;  ///< floats
  double cell = 1;
  bool normals = true;
};

struct GridMesh {
  RawArray<float> positions, normals;               ///< three a vertex
  RawArray<uint32_t> indices;                       ///< three a triangle
  std::array<float, 3> bounds_min{}, bounds_max{};  ///< of the positions; 0 where there is none

  explicit GridMesh(std::pmr::memory_resource* memory) : positions(memory), normals(memory), indices(memory) {}
};

/// Vertices and triangles come in the order of mesh/body.h, whatever the job system does. A vertex on an edge lies at a
/// whole 256th of the cell; the normal there is the gradient interpolated between the edge's two samples.
/// Errors: invalid_argument where a value is not finite, limit where the mesh passes 2^32 - 1 vertices or 2^32 - 1
/// indices.
Result<GridMesh> meshGrid(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory,
                          const MeshKernels& kernels = bestMeshKernels());

}  // namespace sgm::api

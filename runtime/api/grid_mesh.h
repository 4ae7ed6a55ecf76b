#pragma once
// Marching cubes over a caller's grid of floats of any size: quantised, triangulated and welded like chunks, with
// normals from the grid's gradient.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>

#include "backend/cpu/extract/mesh_kernels.h"
#include "base/jobs.h"
#include "base/raw_array.h"
#include "base/result.h"

namespace sgm::api {

/// A grid that the caller owns; the checks of sgm_grid_desc were made.
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
  std::array<float, 3> bounds_min{}, bounds_max{};  ///< of the positions; 0 if there are none

  explicit GridMesh(std::pmr::memory_resource* memory) : positions(memory), normals(memory), indices(memory) {}
};

/// Vertices and triangles have the order of mesh/body.h, whatever the job system does. A vertex on an edge lies at a
/// whole 256th of the cell; its normal is the gradient interpolated between the edge's two samples. Errors:
/// invalid_argument if a value is not finite, limit if the mesh needs more than 2^32 - 1 vertices or indices.
Result<GridMesh> meshGrid(const GridSamples& grid, JobSystem& jobs, std::pmr::memory_resource* memory,
                          const MeshKernels& kernels = bestMeshKernels());

}  // namespace sgm::api

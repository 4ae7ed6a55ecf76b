#pragma once
// The handle of a welded mesh with positions and normals as floats.

#include <array>

#include "api/grid_mesh.h"
#include "api/runtime.h"
#include "base/fixed.h"
#include "texture/unwrapped.h"

struct sgm_surface {
  /// Creates a surface from the mesh of a caller's grid.
  sgm_surface(sgm_runtime& runtime_in, sgm::api::GridMesh&& mesh)
      : runtime(runtime_in),
        positions(std::move(mesh.positions)),
        normals(std::move(mesh.normals)),
        materials(&runtime_in.memory),
        tags(&runtime_in.memory),
        indices(std::move(mesh.indices)),
        texture(&runtime_in.memory),
        bounds_min(mesh.bounds_min),
        bounds_max(mesh.bounds_max) {}
  /// Creates an empty surface, to be filled with the mesh of a region.
  explicit sgm_surface(sgm_runtime& runtime_in)
      : runtime(runtime_in),
        positions(&runtime_in.memory),
        normals(&runtime_in.memory),
        materials(&runtime_in.memory),
        tags(&runtime_in.memory),
        indices(&runtime_in.memory),
        texture(&runtime_in.memory),
        of_grid(false) {}

  sgm_runtime& runtime;
  sgm::RawArray<float> positions, normals;  ///< three floats per vertex
  sgm::RawArray<uint16_t> materials, tags;  ///< one element per vertex; empty for the mesh of a grid
  sgm::RawArray<uint32_t> indices;          ///< three vertex indices per triangle
  sgm::Unwrapped texture;                   ///< texture coordinates; empty if not requested
  std::array<float, 3> bounds_min{}, bounds_max{};
  bool of_grid = true;
  sgm::Int3 origin;
  sgm::IntBox extent{{0, 0, 0}, {0, 0, 0}};
  int32_t cell_units = 0;
  uint64_t chunk_count = 1;
  uint64_t hash = 0;  ///< content hash of a region's mesh; 0 for the mesh of a grid, whose hash is computed on request
};

#pragma once
// The handle of a welded mesh whose positions and normals are floats.

#include <array>

#include "api/grid_mesh.h"
#include "api/runtime.h"
#include "base/fixed.h"
#include "texture/unwrapped.h"

struct sgm_surface {
  /// Makes the surface of a grid.
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
  /// Makes an empty surface, for the mesh of a region.
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
  sgm::RawArray<uint16_t> materials, tags;  ///< one per vertex; empty for a grid
  sgm::RawArray<uint32_t> indices;          ///< three per triangle
  sgm::Unwrapped texture;                   ///< empty if not requested
  std::array<float, 3> bounds_min{}, bounds_max{};
  bool of_grid = true;
  sgm::Int3 origin;
  sgm::IntBox extent{{0, 0, 0}, {0, 0, 0}};
  int32_t cell_units = 0;
  uint64_t chunk_count = 1;
  uint64_t hash = 0;  ///< content hash of a region's mesh; 0 for a grid
};

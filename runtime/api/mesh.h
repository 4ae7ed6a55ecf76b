#pragma once
// The handle of the mesh of one chunk: body and seams in one vertex array and one index array; reference-counted.

#include <memory>

#include "api/runtime.h"
#include "chunk/chunk_surface.h"

struct sgm_mesh {
  sgm_mesh(sgm_runtime& runtime_in, std::shared_ptr<const sgm::ChunkSurface> surface_in);

  sgm_runtime& runtime;
  std::shared_ptr<const sgm::ChunkSurface> surface;
  std::pmr::vector<sgm_anchor> anchors;
};

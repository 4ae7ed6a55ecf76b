#pragma once
// The reference-counted handle of one chunk's mesh, with body and seams in one vertex array and one index array.

#include <memory>

#include "api/runtime.h"
#include "chunk/chunk_surface.h"

struct sgm_mesh {
  sgm_mesh(sgm_runtime& runtime_in, std::shared_ptr<const sgm::ChunkSurface> surface_in);

  sgm_runtime& runtime;
  std::shared_ptr<const sgm::ChunkSurface> surface;
  std::pmr::vector<sgm_anchor> anchors;
};

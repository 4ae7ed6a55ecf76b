#pragma once
// The handle of one chunk's mesh: body and seams in one vertex array and one index array, counted by reference.

#include <array>
#include <atomic>
#include <span>

#include "api/raw_array.h"
#include "api/runtime.h"
#include "mesh/chunk.h"

namespace sgm::api {

/// What a chunk's mesh is made of. parts[0] is the body, parts[1 + face] a seam; null or empty where there is none.
struct MeshSource {
  sgm_chunk_key key{};
  ChunkGrid grid;
  std::array<const MeshPart*, 7> parts{};
  std::span<const sgm_anchor> anchors;
};

}  // namespace sgm::api

struct sgm_mesh {
  sgm_mesh(sgm_runtime& runtime_in, const sgm::api::MeshSource& source);

  sgm_runtime& runtime;
  std::atomic<uint32_t> owners{1};
  sgm_chunk_key key;
  sgm::ChunkGrid grid;
  sgm::IntBox bounds{{0, 0, 0}, {0, 0, 0}};
  sgm::api::RawArray<sgm_vertex> vertices;
  sgm::api::RawArray<uint32_t> indices;
  std::array<sgm_mesh_range, 7> ranges{};  ///< body, then seams by face
  uint64_t hash = 0;
  std::pmr::vector<sgm_anchor> anchors;
  std::pmr::vector<uint16_t> tags;
};

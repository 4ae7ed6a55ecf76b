#pragma once
// The handle of a field: one world, and the backend that meshes it.

#include <memory>

#include "api/grammar.h"
#include "api/runtime.h"
#include "backend/backend.h"
#include "stream/world_field.h"

struct sgm_field {
  sgm_field(sgm_runtime& runtime_in, sgm::WorldFieldSettings settings, std::unique_ptr<sgm::Backend> backend_in)
      : runtime(runtime_in), world(std::move(settings), &runtime_in.memory), backend(std::move(backend_in)) {}

  sgm_runtime& runtime;
  sgm::WorldField world;
  std::unique_ptr<sgm::Backend> backend;
};

namespace sgm::api {

inline constexpr int32_t kLargestFinestCell = 1 << 20;
/// Of any level: what the rounding of vertices to units holds for (mesh/vertex.h).
inline constexpr int64_t kLargestCell = int64_t{1} << 22;

/// SGM_OK where the field has cells at the level; else INVALID_ARGUMENT (no such level) or RANGE (its cells are too
/// large).
sgm_result checkLevel(const sgm_field& field, int32_t level, sgm_error* error);

}  // namespace sgm::api

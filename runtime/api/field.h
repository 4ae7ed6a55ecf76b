#pragma once
// The handle of a field: one world, and the backend that meshes it.

#include <atomic>
#include <memory>

#include "api/grammar.h"
#include "api/runtime.h"
#include "backend/backend.h"
#include "stream/world_field.h"

struct sgm_field {
  sgm_field(sgm_runtime& runtime_in, sgm::WorldFieldSettings settings, std::unique_ptr<sgm::Backend> backend_in)
      : runtime(runtime_in), world(std::move(settings), &runtime_in.memory), backend(std::move(backend_in)) {}

  sgm_runtime& runtime;
  std::atomic<uint32_t> owners{1};  ///< the caller's, and the worlds that stream it
  sgm::WorldField world;
  std::unique_ptr<sgm::Backend> backend;
};

namespace sgm::api {

inline constexpr int32_t kLargestFinestCell = 1 << 20;
/// Of any level: what the rounding of vertices to units holds for (mesh/vertex.h).
inline constexpr int64_t kLargestCell = int64_t{1} << 22;

/// One more owner, whom sgm_field_destroy takes away again.
inline void acquireField(sgm_field* field) { field->owners.fetch_add(1, std::memory_order_relaxed); }

/// SGM_OK where the field has cells at the level; else INVALID_ARGUMENT (no such level) or RANGE (its cells are too
/// large).
sgm_result checkLevel(const sgm_field& field, int32_t level, sgm_error* error);

}  // namespace sgm::api

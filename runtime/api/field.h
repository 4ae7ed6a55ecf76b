#pragma once
// The handle of a field: a world, and the backend that meshes it.

#include <memory>

#include "api/grammar.h"
#include "api/runtime.h"
#include "backend/backend.h"
#include "world/world_field.h"

namespace sgm::api {

/// The content of a field, owned by its handle and by the worlds that stream it.
struct FieldContent {
  FieldContent(WorldFieldSettings settings, std::pmr::memory_resource* memory, std::shared_ptr<Backend> backend_in)
      : world(std::move(settings), memory), backend(std::move(backend_in)) {}

  WorldField world;
  std::shared_ptr<Backend> backend;
};

/// The field, with ownership of all its parts.
inline std::shared_ptr<const WorldField> worldField(const std::shared_ptr<FieldContent>& content) {
  return {content, &content->world};
}

}  // namespace sgm::api

struct sgm_field {
  sgm_field(sgm_runtime& runtime_in, std::shared_ptr<sgm::api::FieldContent> content_in)
      : runtime(runtime_in), content(std::move(content_in)) {}

  sgm_runtime& runtime;
  std::shared_ptr<sgm::api::FieldContent> content;
};

namespace sgm::api {

/// Units per metre, for doubles that the interface takes in metres.
inline constexpr double kUnits = SGM_UNITS_PER_METRE;
/// The limit for chunks of a region or of a search, if the caller names none.
inline constexpr uint64_t kDefaultMostChunks = 65536;
inline constexpr int32_t kLargestFinestCell = 1 << 20;
/// The largest cell of any level: the rounding of vertices to units allows no larger one (mesh/vertex.h).
inline constexpr int64_t kLargestCell = int64_t{1} << 22;

/// SGM_OK if a field with this finest cell, in units, has cells at the level; else INVALID_ARGUMENT (invalid level) or
/// RANGE (its cells are too large).
sgm_result checkLevel(int32_t finest_cell, int32_t level, sgm_error* error);

}  // namespace sgm::api

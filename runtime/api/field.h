#pragma once
// The handle of a field: the internal field, and the backend that meshes it.

#include <memory>

#include "api/grammar.h"
#include "api/runtime.h"
#include "backend/backend.h"
#include "world/world_field.h"

namespace sgm::api {

/// The content of an sgm_field. The handle and the worlds that stream the field share ownership of it.
struct FieldContent {
  FieldContent(WorldFieldSettings settings, std::pmr::memory_resource* memory, std::shared_ptr<Backend> backend_in)
      : world(std::move(settings), memory), backend(std::move(backend_in)) {}

  WorldField world;
  std::shared_ptr<Backend> backend;
};

/// Returns a pointer to the internal field, which shares ownership of the whole content.
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

/// Units per metre, as double, to convert positions and lengths in metres.
inline constexpr double kUnits = SGM_UNITS_PER_METRE;
/// The maximum number of chunks in a region or a path search, unless the caller sets another limit.
inline constexpr uint64_t kDefaultMostChunks = 65536;
inline constexpr int32_t kLargestFinestCell = 1 << 20;
/// The maximum cell edge of any level, in units. With larger cells, vertex positions could not be rounded to units in
/// 32-bit arithmetic (mesh/vertex.h).
inline constexpr int64_t kLargestCell = int64_t{1} << 22;

/// Checks a level of detail for a field. finest_cell: its cell edge at level 0, in units. Returns SGM_OK,
/// SGM_ERR_INVALID_ARGUMENT (the level is not 0..SGM_MAX_LEVEL) or SGM_ERR_RANGE (its cells would be too large).
sgm_result checkLevel(int32_t finest_cell, int32_t level, sgm_error* error);

}  // namespace sgm::api

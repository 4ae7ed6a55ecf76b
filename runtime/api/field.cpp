#include "api/field.h"

#include <cmath>

#include "api/backend_request.h"
#include "api/barrier.h"
#include "api/host_field.h"
#include "backend/open/open_backend.h"
#include "chunk/mesh_chunks.h"

using namespace sgm::api;

static_assert(SGM_MAX_LEVEL == sgm::kMaxLevel);

namespace sgm::api {

sgm_result checkLevel(int32_t finest_cell, int32_t level, sgm_error* error) {
  if (level < 0 || level > SGM_MAX_LEVEL)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "level is not between 0 and " + std::to_string(SGM_MAX_LEVEL));
  if (int64_t{finest_cell} << level > kLargestCell)
    return fail(
        error, SGM_ERR_RANGE,
        "the cells of level " + std::to_string(level) + " are larger than " + std::to_string(kLargestCell) + " units");
  return SGM_OK;
}

}  // namespace sgm::api

sgm_result sgm_field_create(sgm_runtime* runtime, const sgm_field_desc* desc, sgm_field** out, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (out == nullptr) return nullArgument(error, "out");
    *out = nullptr;
    if (runtime == nullptr) return nullArgument(error, "runtime");
    if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
    if (desc->grammar == nullptr) return nullArgument(error, "desc.grammar");
    if (desc->cell_units < 1 || desc->cell_units > kLargestFinestCell)
      return fail(error, SGM_ERR_INVALID_ARGUMENT,
                  "desc.cell_units is not between 1 and " + std::to_string(kLargestFinestCell));
    const std::optional<sgm::BackendRequest> request = requestOf(desc->backend);
    if (!request) return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.backend is not a valid sgm_backend");
    if (desc->parameters != nullptr && desc->parameters->program != desc->grammar->program)
      return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.parameters belongs to another grammar");

    sgm::WorldFieldSettings settings;
    settings.program = desc->grammar->program;
    settings.parameters =
        desc->parameters != nullptr ? desc->parameters->values : sgm::ParameterValues::defaults(*settings.program);
    settings.seed = desc->seed;
    settings.finest_cell = desc->cell_units;
    if (desc->cache_bytes != 0) settings.cache_bytes = desc->cache_bytes;
    if (runtime->sink.write != nullptr)
      settings.on_notes = [notes = desc->grammar->notes](const sgm::GrammarChunk& cell) { notes->tell(cell); };
    settings.profiler = runtime->profiler;
    if (sgm_result r = takeHosts(error, *desc, *settings.program, settings.hosts); r != SGM_OK) return r;
    sgm::Result<std::shared_ptr<sgm::Backend>> backend = backendFor(*runtime, *request);
    if (!backend) return fail(error, backend.error());
    auto content = std::allocate_shared<FieldContent>(std::pmr::polymorphic_allocator<>(&runtime->memory),
                                                      std::move(settings), &runtime->memory, std::move(*backend));
    *out = makeHandle<sgm_field>(*runtime, std::move(content));
    return SGM_OK;
  });
}

sgm_result sgm_field_destroy(sgm_field* field) { return releaseHandle(field, __func__); }

sgm_result sgm_cell_from_metres(double metres, int32_t* units, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (units == nullptr) return nullArgument(error, "units");
    if (!(metres > 0)) return fail(error, SGM_ERR_INVALID_ARGUMENT, "the cell's edge is not a number above 0");
    const double rounded = std::floor(metres * SGM_UNITS_PER_METRE + 0.5);
    if (!(rounded >= 1))
      return fail(error, SGM_ERR_INVALID_ARGUMENT, "the cell's edge is below half a unit: the smallest is 1/1024 m");
    if (!(rounded <= kLargestFinestCell))
      return fail(error, SGM_ERR_INVALID_ARGUMENT, "the cell's edge is too large: the largest is 1024 m");
    *units = static_cast<int32_t>(rounded);
    return SGM_OK;
  });
}

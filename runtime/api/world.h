#pragma once
// The handle of a streamed world. The handle owns the backend; the internal world owns the fields that it needs.

#include <memory>

#include "api/barrier.h"
#include "api/field.h"
#include "stream/world.h"

struct sgm_world {
  sgm_world(sgm_runtime& runtime_in, std::shared_ptr<sgm::Backend> backend_in, int32_t finest_cell_in,
            std::unique_ptr<sgm::World> world_in)
      : runtime(runtime_in), backend(std::move(backend_in)), finest_cell(finest_cell_in), world(std::move(world_in)) {}

  sgm_runtime& runtime;
  std::shared_ptr<sgm::Backend> backend;
  const int32_t finest_cell;          ///< cell edge at level 0, in units; equal for all fields of the world
  std::unique_ptr<sgm::World> world;  ///< declared last, because it must be destroyed before its backend
};

namespace sgm::api {

/// Writes an error to `error` and returns its code. Code::bad_input becomes SGM_ERR_DATA, because world functions read
/// data files, not a grammar.
inline sgm_result failData(sgm_error* error, const Error& e) {
  return fail(error, e.code == Code::bad_input ? SGM_ERR_DATA : resultOf(e.code), e.message);
}

/// Logs an error, writes it to `error` and returns its code. Logged because games often ignore the results of functions
/// that they call every frame.
inline sgm_result failLogged(const sgm_world& world, sgm_error* error, const Error& e) {
  world.runtime.log(SGM_LOG_WARNING, e.message);
  return failData(error, e);
}

}  // namespace sgm::api

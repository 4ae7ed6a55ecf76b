#pragma once
// The handle of a streamed world. It owns its backend; the world owns the fields that it needs.

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
  const int32_t finest_cell;          ///< cell edge of level 0 of all its fields, in units
  std::unique_ptr<sgm::World> world;  ///< destroyed before its backend
};

namespace sgm::api {

/// Fills `error` and returns its code: SGM_ERR_DATA for Code::bad_input, because the invalid data is not a grammar
/// here.
inline sgm_result failData(sgm_error* error, const Error& e) {
  return fail(error, e.code == Code::bad_input ? SGM_ERR_DATA : resultOf(e.code), e.message);
}

/// Fills `error`, logs it, and returns its code: games often ignore the results of the functions that they call every
/// frame.
inline sgm_result failLogged(const sgm_world& world, sgm_error* error, const Error& e) {
  world.runtime.log(SGM_LOG_WARNING, e.message);
  return failData(error, e);
}

}  // namespace sgm::api

#pragma once
// The handle of a streamed world, which keeps its field.

#include <memory>

#include "api/barrier.h"
#include "api/field.h"
#include "stream/world.h"

struct sgm_world {
  sgm_world(sgm_runtime& runtime_in, std::shared_ptr<sgm::api::FieldContent> field_in,
            std::unique_ptr<sgm::World> world_in)
      : runtime(runtime_in), field(std::move(field_in)), world(std::move(world_in)) {}

  sgm_runtime& runtime;
  std::shared_ptr<sgm::api::FieldContent> field;
  std::unique_ptr<sgm::World> world;  ///< ends before its field
};

namespace sgm::api {

/// Fails where what came from elsewhere is no text of a grammar.
inline sgm_result failData(sgm_error* error, const Error& e) {
  return fail(error, e.code == Code::bad_input ? SGM_ERR_DATA : resultOf(e.code), e.message);
}

/// Fails, and tells the log: a game that overlooks a result of a frame finds it there.
inline sgm_result failLogged(const sgm_world& world, sgm_error* error, const Error& e) {
  world.runtime.log(SGM_LOG_WARNING, e.message);
  return failData(error, e);
}

}  // namespace sgm::api

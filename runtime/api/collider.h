#pragma once
// The reference-counted handle of one chunk's collision mesh.

#include <memory>

#include "api/runtime.h"
#include "stream/make/collider.h"

struct sgm_collider {
  sgm_collider(sgm_runtime& runtime_in, std::shared_ptr<const sgm::Collider> collider_in)
      : runtime(runtime_in), collider(std::move(collider_in)) {}

  sgm_runtime& runtime;
  std::shared_ptr<const sgm::Collider> collider;
};

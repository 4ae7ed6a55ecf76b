#pragma once
// Anchors as the C interface shows them.

#include <vector>

#include "base/result.h"
#include "sgm/sgm.h"
#include "stream/world_field.h"

namespace sgm::api {

/// Those in lo <= p < hi, in the world's own order.
Result<std::vector<sgm_anchor>> anchorsIn(const WorldField& world, const IntBox& box);

}  // namespace sgm::api

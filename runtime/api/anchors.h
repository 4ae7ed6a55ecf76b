#pragma once
// Anchors as the C interface shows them.

#include "derive/shape.h"
#include "sgm/sgm.h"

namespace sgm::api {

sgm_anchor anchorOf(const Anchor& anchor);

}  // namespace sgm::api

#pragma once
// Converts anchors to the C interface.

#include "derive/shape.h"
#include "sgm/sgm.h"

namespace sgm::api {

sgm_anchor anchorOf(const Anchor& anchor);

}  // namespace sgm::api

#pragma once
// Converts anchors (oriented points that a grammar places) to the structs of the C interface.

#include "derive/shape.h"
#include "sgm/sgm.h"

namespace sgm::api {

sgm_anchor anchorOf(const Anchor& anchor);

}  // namespace sgm::api

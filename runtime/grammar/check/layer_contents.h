#pragma once
// Finds the levels of detail at which a layer has visible content, and whether it has anchors. Content within a
// `detail` statement is visible only at levels whose cell edge does not exceed the statement's length. Layers without
// content need not be derived.

#include "grammar/syntax/program.h"
#include "grammar/text/limits.h"

namespace sgm {

/// Sets Layer::coarsest_cell, Layer::by_level and Layer::anchors. Precondition: the program has no errors.
void findLayerContents(Program& program, const CompileLimits& limits);

}  // namespace sgm

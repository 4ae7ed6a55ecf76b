#pragma once
// The content of a layer: the levels at which it is visible, that is, those with cells no larger than every `detail`
// around its content, and whether it has anchors. Layers without content need not be derived.

#include "grammar/syntax/program.h"
#include "grammar/text/limits.h"

namespace sgm {

/// Sets Layer::coarsest_cell, by_level and anchors. Precondition: the program has no errors.
void findLayerContents(Program& program, const CompileLimits& limits);

}  // namespace sgm

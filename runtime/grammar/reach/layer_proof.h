#pragma once
// The extent of a layer's start, and its comparison with the layer's declaration.

#include <cstdint>

#include "grammar/range/extent.h"
#include "grammar/reach/reach_context.h"

namespace sgm::reach {

/// The distances by which shapes exceed their layer's declaration, metres: possibly, and certainly.
struct Excess {
  double may = 0, sure = 0;
};

/// Whether the layer is a finite domain's, which has no cells.
bool isFinite(const Program& program, const Layer& layer);
/// The edge along the axes that are cut into cells, metres.
double cellEdge(const Layer& layer);

/// Sets the cell of the proof to a layer's.
void setCell(const Layer& layer, ReachContext& context);

Excess measureExcess(const Program& program, const Layer& layer, const Extent& extent);
/// Whether the extent proves the layer's declaration. It proves nothing if the attempt was cut short.
bool isEnough(const Layer& layer, const Extent& extent, const ReachContext& context);

/// The extent of a layer's start, by one evaluation in the current mode. index: into Program::layers.
Extent boundStart(uint32_t index, ReachContext& context);
/// The same, by as many attempts as it takes to prove the layer's declaration: the last ones divide ranges into pieces.
Extent proveStart(uint32_t index, ReachContext& context);

}  // namespace sgm::reach

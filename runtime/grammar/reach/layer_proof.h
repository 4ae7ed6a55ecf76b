#pragma once
// Computes the extent of a layer's start rule, and compares it with the layer's declaration.

#include <cstdint>

#include "grammar/range/extent.h"
#include "grammar/reach/reach_context.h"

namespace sgm::reach {

/// The distances in metres by which shapes exceed their layer's declaration. may: they possibly exceed it by this
/// distance; sure: they certainly exceed it by this distance.
struct Excess {
  double may = 0, sure = 0;
};

/// Whether the layer belongs to a finite domain, which is not divided into cells.
bool isFinite(const Program& program, const Layer& layer);
/// The edge of the layer's cell along the axes that are divided into cells, metres.
double cellEdge(const Layer& layer);

/// Sets context.cell to the layer's cell.
void setCell(const Layer& layer, ReachContext& context);

Excess measureExcess(const Program& program, const Layer& layer, const Extent& extent);
/// Whether the extent lies within what the layer declares (its cell and reach, or the domain's box), so that the proof
/// succeeds. Always false if the step budget cut the attempt short.
bool isEnough(const Layer& layer, const Extent& extent, const ReachContext& context);

/// Computes the extent of a layer's start rule by a single evaluation, in the current RangePieces mode. index: index of
/// the layer in Program::layers.
Extent boundStart(uint32_t index, ReachContext& context);
/// Like boundStart(), but makes several attempts until an extent lies within what the layer declares. The last attempts
/// evaluate ranges of values in pieces.
Extent proveStart(uint32_t index, ReachContext& context);

}  // namespace sgm::reach

#pragma once
// How water and weather act on a place, by the surfaces around it.

#include "tools/render/sampling.h"
#include "tools/render/traced_scene.h"

namespace sgm {

/// The depth of water at a place of its surface, metres. The bed is assumed to slope like the shore: a third of the
/// distance to the shore, as a mean over several directions.
float depthOf(const TracedScene& scene, const MetSurface& place, UnitPoints& points);

/// How wet a surface above water is, 0..1: decreases with height.
float wetness(const TracedScene& scene, const MetSurface& place);

/// How much a ledge keeps rain off a wall, 0..1.
float ledgeOver(const TracedScene& scene, const MetSurface& place);

/// Nearness of a wall's foot, 0..1: of a flat surface before it that is wider than a ledge.
float footUnder(const TracedScene& scene, const MetSurface& place);

}  // namespace sgm

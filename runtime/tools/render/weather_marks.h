#pragma once
// The effects of water and weather on a place, derived from the surfaces around it.

#include "tools/render/sampling.h"
#include "tools/render/traced_scene.h"

namespace sgm {

/// Estimated depth of water in metres at a place on its surface. It grows by a third of a metre for each metre of
/// distance to the shore, and is a mean over several directions.
float depthOf(const TracedScene& scene, const MetSurface& place, UnitPoints& points);

/// Wetness of a surface just above water, 0..1; it decreases with the height above the water.
float wetness(const TracedScene& scene, const MetSurface& place);

/// How much a ledge above a place on a wall keeps rain off the place, 0..1: 1 just below the ledge, 0 if there is no
/// ledge.
float ledgeOver(const TracedScene& scene, const MetSurface& place);

/// How near a place on a wall is to the wall's foot, 0..1. The ground at the foot must be flat and wider than a ledge.
float footUnder(const TracedScene& scene, const MetSurface& place);

}  // namespace sgm

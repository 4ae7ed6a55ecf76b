#pragma once
// A preview picture in a fraction of a second, for the time until the real one is drawn.

#include <functional>

#include "base/jobs.h"
#include "base/result.h"
#include "tools/render/image.h"
#include "tools/render/ray_caster.h"
#include "tools/render/scene.h"

namespace sgm {

/// Draws the scene on the CPU alone: every surface in its material's plain colour, with hard shadows of the scene's
/// lights, and even ambient light. mesh: a tree over the scene's triangles. The same scene gives the same bytes.
/// Errors: invalid_argument (a camera out of range, too many lamps, no material), out_of_memory.
Result<Image> sketch(const RenderScene& scene, const RayCaster& mesh, JobSystem& jobs);

}  // namespace sgm

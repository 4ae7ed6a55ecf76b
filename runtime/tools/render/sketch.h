#pragma once
// A picture within a fraction of a second, to look at while the real one is drawn.

#include <functional>

#include "base/jobs.h"
#include "base/result.h"
#include "tools/render/image.h"
#include "tools/render/ray_caster.h"
#include "tools/render/scene.h"

namespace sgm {

/// Draws the scene on processors alone: every surface in its material's plain colour, lit by the scene's lights with
/// hard shadows, and evenly from around. mesh is a tree over the scene's triangles. The same scene gives the same
/// bytes. Errors: invalid_argument (a camera out of range, too many lamps, no material), out_of_memory.
Result<Image> sketch(const RenderScene& scene, const RayCaster& mesh, JobSystem& jobs);

}  // namespace sgm

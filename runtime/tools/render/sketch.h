#pragma once
// Draws a preview in a fraction of a second, to be shown until the final picture is ready.

#include <functional>

#include "base/jobs.h"
#include "base/result.h"
#include "tools/render/image.h"
#include "tools/render/ray_caster.h"
#include "tools/render/scene.h"

namespace sgm {

/// Draws a preview of the scene on the CPU: surfaces in plain colours, hard shadows and even ambient light. mesh: ray
/// caster over the scene's triangles. The same scene gives the same bytes. Errors: invalid_argument if a camera value
/// is out of range, there are too many lamps or no material; out_of_memory.
Result<Image> sketch(const RenderScene& scene, const RayCaster& mesh, JobSystem& jobs);

}  // namespace sgm

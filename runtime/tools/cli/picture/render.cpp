// `sgm render`: draws a picture of a region of a grammar's world.

#include <fmt/core.h>

#include "base/json.h"
#include "tools/cli/picture/seed_sheet.h"
#include "tools/cli/picture/survey.h"
#include "tools/support/console.h"
#include "tools/support/drawable_region.h"
#include "tools/support/ending_signals.h"
#include "tools/support/region_picture.h"
#include "tools/support/render_options.h"

namespace sgm::cli {
namespace {

std::string cornerText(Int3 corner) {
  return fmt::format("{:.10f},{:.10f},{:.10f}", metres(corner.x), metres(corner.y), metres(corner.z));
}

/// Returns options for meshing the same region again: they state the region's box, its cell size, and a camera that is
/// chosen to show it.
Result<RenderOptions> withCamera(const RenderOptions& options, const Region& region) {
  const Result<RegionScene> scene = sceneOf(options, region);
  if (!scene) return scene.error();
  RenderOptions settled = options;
  settled.camera = gazeText(worldGaze(scene->view.camera, region.meshed.mesh.origin));
  settled.fov = scene->view.camera.fov_degrees;
  settled.region = cornerText(region.meshed.extent.lo) + ':' + cornerText(region.meshed.extent.hi);
  settled.frame.clear();
  if (scene->view.at_anchor) settled.at.clear();  // the chosen camera already stands at the anchor that --at names
  settled.cell = metres(region.cell);
  settled.density.reset();
  settled.level = 0;
  return settled;
}

/// Meshes the region that the options select. If --pixels requires smaller cells near the camera, but no camera is
/// given, meshes the region twice: first with cells of one size, to choose the camera; then with smaller cells near the
/// camera.
RegionResult meshPicture(RenderOptions& options, std::optional<RegionDensity>& density) {
  RegionResult made = meshRegion(options, picturePlan(options, density));
  if (!made.region || !options.pixels || !options.camera.empty() || !checkDrawable(options, *made.region)) return made;
  Result<RenderOptions> settled = withCamera(options, *made.region);
  if (!settled) return {std::nullopt, reportError(settled.error())};
  options = std::move(*settled);
  RegionPlan plan = picturePlan(options, density);
  plan.notes = false;  // the first meshing has already printed the notes
  Result<Region> again = meshProgram(made.region->program, options, plan);
  if (!again) return {std::nullopt, reportError(again.error())};
  made.region = std::move(*again);
  return made;
}

}  // namespace

Exit render(const RenderOptions& asked) {
  RenderOptions options = asked;
  if (options.plan || options.section) return drawSurvey(options);
  if (!hasExtension(options.out, ".png"))
    return reportError(Exit::usage, "--out: pictures are .png files; --plan and --section write .svg too");
  if (!options.seeds.empty()) return drawSeeds(options);
  // Open the GPU and the output file before the long meshing, so that their errors are reported at once.
  const Result<Renderer> renderer = Renderer::create();
  if (!renderer) return reportError(renderer.error());
  Result<FileWriter> file = FileWriter::create(options.out, &unfinished_files);
  if (!file) return reportError(file.error());
  std::optional<RegionDensity> density;
  const RegionResult made = meshPicture(options, density);
  if (!made.region) return made.status;
  const Region& region = *made.region;
  if (const Result<void> drawable = checkDrawable(options, region); !drawable) return reportError(drawable.error());

  const Stopwatch watch;
  const Result<RegionPicture> picture = drawRegion(*renderer, options, region, density);
  if (!picture) return reportError(picture.error());
  const Image& image = picture->image;
  const View& view = picture->view;
  if (Result<void> ok = writePng(image, *file); !ok) return reportError(ok.error());
  if (!options.at.empty() && !view.at_anchor)
    fmt::print(stderr,
               "note: --at {} is ignored: no such anchor is in a room or a cave; place the camera with --camera\n",
               options.at);

  const RenderCamera& camera = view.camera;
  const auto [position, target] = worldGaze(camera, region.meshed.mesh.origin);
  if (options.json) {
    Json json{{"out", options.out}, {"width", image.width}, {"height", image.height}};
    json.update(toJson(options, region));
    if (density) json["volume"] = toJson(*density);
    json.update({{"draw_seconds", watch.seconds()},
                 {"device", renderer->info().name},
                 {"camera",
                  {{"position", {position[0], position[1], position[2]}},
                   {"target", {target[0], target[1], target[2]}},
                   {"fov", camera.fov_degrees},
                   {"enclosed", view.enclosed}}},
                 {"light", lightName(picture->light)},
                 {"daylight", picture->daylight ? Json(*picture->daylight) : Json(nullptr)}});
    if (picture->framed) json["frame"] = toJson(*picture->framed);
    fmt::print("{}\n", json.text());
  } else {
    fmt::print("{}: {}x{} pixels, {} triangles meshed in {:.2f} s, drawn in {:.2f} s on {}\n", options.out, image.width,
               image.height, region.meshed.mesh.indices.size() / 3, region.seconds, watch.seconds(),
               renderer->info().name);
    if (density)
      fmt::print("  density  at {} points in {:.2f} s, {} of {} bricks proven to be empty or full\n",
                 density->values.size(), density->seconds, density->figures.uniform, density->figures.bricks);
    if (isCut(region))
      fmt::print("  border   cuts the surface, which continues outside: --region shows more or less of it\n");
    fmt::print("  camera   at {:.1f},{:.1f},{:.1f} m{}\n", position[0], position[1], position[2],
               view.enclosed ? ", inside" : "");
    if (picture->framed) fmt::print("  frame    {}\n", textOf(*picture->framed));
    if (picture->daylight)
      fmt::print("  light    {}: {:.1f} % of the sky is open to the visible surfaces (--light chooses)\n",
                 lightName(picture->light), 100 * *picture->daylight);
  }
  return Exit::done;
}

}  // namespace sgm::cli

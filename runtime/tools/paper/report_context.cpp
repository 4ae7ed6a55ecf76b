#include "tools/paper/report_context.h"

#include <fmt/core.h>

#include "region/places.h"
#include "tools/cli/measure/commands.h"
#include "tools/paper/bundle.h"
#include "tools/paper/command_line.h"
#include "tools/paper/commands.h"
#include "tools/support/measured_mesh.h"
#include "tools/support/region_picture.h"
#include "tools/support/render_options.h"

namespace sgm::cli {
namespace {

Result<Region> meshBundled(const WorldOptions& options, const RegionPlan& plan) {
  const CompileResult compiled = compileBundled(ReportContext::grammarOf(options));
  if (!compiled.program) return Error{Code::bad_input, renderDiagnostics(compiled)};
  Result<Region> region = meshProgram(compiled.program, options, plan);
  if (!region) return Error{region.error().code, fmt::format("{}: {}", options.file, region.error().message)};
  if (region->meshed.mesh.indices.empty())
    return Error{Code::bad_input, fmt::format("{}: there is no surface: {}", options.file, region->empty_because)};
  return region;
}

}  // namespace

Result<Region> ReportContext::mesh(const WorldOptions& options, bool texture) const {
  RegionPlan plan;
  plan.doing = doing_;
  plan.texture = texture;
  plan.choose = [](const WorldField& world) { return blockRegion(*world.settings().program, 1); };
  return meshBundled(options, plan);
}

Result<measure::MeshMeasures> ReportContext::measure(const MeasureOptions& options) const {
  const Result<Region> region = mesh(options);
  if (!region) return region.error();
  const asset::TriangleMesh triangles = trianglesOf(*region);
  measure::MeshSettings settings;
  settings.self_intersections = !options.no_self_intersections;
  settings.cubes = options.cubes;
  settings.histogram.bins = options.bins;
  settings.histogram.mode = measure::modeNamed(options.mode).value_or(settings.histogram.mode);
  return measure::measureMesh({triangles.points, triangles.triangles}, settings, jobs_);
}

Result<Markup> ReportContext::picture(RenderOptions options, const std::string& name, const std::string& alt,
                                      const std::string& caption, std::vector<std::string>& commands) {
  if (renderer_ == nullptr) return Markup{};
  // The printed command must write its picture outside the report's folder, which may contain no additional files.
  options.out = "../" + name + ".png";
  std::optional<RegionDensity> density;
  RegionPlan plan = picturePlan(options, density);
  plan.doing = doing_;
  const Result<Region> region = meshBundled(options, plan);
  if (!region) return region.error();
  const Result<RegionPicture> drawn = drawRegion(*renderer_, options, *region, density);
  if (!drawn) return drawn.error();
  const Result<std::vector<std::byte>> png = encodePng(drawn->image);
  if (!png) return png.error();
  const std::string path = fmt::format("pictures/{}.png", name);
  pictures_.push_back({path, std::string(reinterpret_cast<const char*>(png->data()), png->size())});
  commands.push_back(commandOf(options));
  const Markup image = emptyElement("img", {{"src", path},
                                            {"alt", alt},
                                            {"width", std::to_string(drawn->image.width)},
                                            {"height", std::to_string(drawn->image.height)}});
  return element("figure", image + element("figcaption", caption)) + Markup{"\n"};
}

std::string commandOfPart(const PaperOptions& options, const std::string& part) {
  std::string line = fmt::format("sgm paper --only {} --out ../{}", part, part);
  if (options.quick) line += " --quick";
  if (options.no_pictures) line += " --no-pictures";
  if (options.backend != PaperOptions{}.backend) line += " --backend " + options.backend;
  if (options.threads != 0) line += fmt::format(" --threads {}", options.threads);
  if (options.seed != PaperOptions{}.seed) line += fmt::format(" --seed {}", options.seed);
  return line;
}

}  // namespace sgm::cli

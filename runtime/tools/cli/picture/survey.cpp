#include "tools/cli/picture/survey.h"

#include <fmt/core.h>

#include <filesystem>

#include "base/json.h"
#include "tools/support/drawable_region.h"
#include "tools/support/ending_signals.h"
#include "tools/support/region.h"
#include "tools/support/region_picture.h"
#include "tools/support/render_options.h"
#include "tools/survey/raster.h"
#include "tools/survey/sheet.h"
#include "tools/survey/svg.h"

namespace sgm::cli {
namespace {

std::string nameOfFile(const std::string& file) { return std::filesystem::path(file).filename().string(); }

std::string boxText(const IntBox& box) {
  return fmt::format("x {:g} to {:g}, y {:g} to {:g}, z {:g} to {:g} m", metres(box.lo.x), metres(box.hi.x),
                     metres(box.lo.y), metres(box.hi.y), metres(box.lo.z), metres(box.hi.z));
}

/// The field samples of a survey, and the drawing made from these samples.
struct Survey {
  survey::Columns columns;
  std::optional<survey::Slice> slice;
  survey::SheetFigures figures;
};

Result<Survey> sampleSurvey(const RenderOptions& options, const OpenedWorld& opened) {
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return jobs.error();
  const int32_t finest = opened.settings.finest_cell;
  if (const Result<void> few = checkChunks(options, opened.region, finest); !few) return few.error();
  const WorldField world(opened.settings, std::pmr::new_delete_resource());
  if (!options.at.empty()) {
    const Result<std::vector<Anchor>> anchors = world.anchors(opened.region);
    if (!anchors) return anchors.error();
    if (const Result<void> there = checkAnchor(*opened.program, *anchors, options.at); !there) return there.error();
  }
  ProgressBar bar("sampling");
  Result<survey::Columns> columns =
      survey::sampleColumns(world, opened.region, options.level, **jobs, [&bar](uint64_t done, uint64_t total) {
        bar.show(done, total);
        return true;
      });
  if (!columns) return columns.error();
  Survey made{std::move(*columns), std::nullopt, {}};
  if (made.columns.stretches.empty())
    return Error{Code::invalid_argument,
                 made.columns.subject == survey::Subject::hollow
                     ? "there is nothing to draw: the region is rock without a void; choose another --region"
                     : "there is nothing to draw: nothing stands in the region; choose another --region"};
  if (!options.section) return made;
  const survey::CutLine line =
      options.section->empty() ? survey::longestCut(made.columns) : *survey::readCutLine(*options.section);
  Result<survey::Slice> slice = survey::sampleSlice(world, made.columns, options.level, line, **jobs);
  if (!slice) return slice.error();
  made.slice = std::move(*slice);
  return made;
}

Json toJson(const RenderOptions& options, const survey::Drawing& drawing, const Survey& made) {
  const survey::PlanFigures& plan = made.figures.plan;
  Json json{{"out", options.out},
            {"width", drawing.width},
            {"height", drawing.height},
            {"seed", options.seed},
            {"level", options.level},
            {"cell", metres(made.columns.step)},
            {"region", {metresJson(made.columns.extent.lo), metresJson(made.columns.extent.hi)}},
            {"subject", made.columns.subject == survey::Subject::hollow ? "void" : "solid"},
            {"pixels_per_metre", made.figures.scale}};
  if (options.plan) {
    Json water = Json::array();
    for (const double level : plan.water) water.push_back(level);
    json["plan"] = {{"contour_interval", plan.interval},
                    {"area", plan.area},
                    {"lowest", plan.lowest},
                    {"highest", plan.highest},
                    {"water", water},
                    {"dripstones", plan.dripstones},
                    {"leads", plan.leads}};
  }
  if (made.slice) {
    const survey::CutLine& line = made.slice->line;
    const survey::SectionFigures& section = made.figures.section;
    json["section"] = {{"from", {line.x0, line.z0}},
                       {"to", {line.x1, line.z1}},
                       {"area", section.area},
                       {"lowest", section.lowest},
                       {"highest", section.highest}};
  }
  return json;
}

}  // namespace

Exit drawSurvey(const RenderOptions& options) {
  const PictureSize size = *readSize(options.size);
  if (size.width < survey::kLeastSheet || size.height < survey::kLeastSheet)
    return reportError(Exit::usage,
                       fmt::format("--size: a plan or a section needs at least {0}x{0} pixels", survey::kLeastSheet));
  Result<FileWriter> file = FileWriter::create(options.out, &unfinished_files);
  if (!file) return reportError(file.error());
  std::optional<RegionDensity> no_density;
  const OpenedWorld opened = openWorld(options, picturePlan(options, no_density));
  if (opened.program == nullptr) return opened.status;
  const Stopwatch watch;
  Result<Survey> made = sampleSurvey(options, opened);
  if (!made) return reportError(made.error());

  survey::SheetRequest request;
  request.width = size.width;
  request.height = size.height;
  request.plan = options.plan;
  request.title = nameOfFile(options.file);
  request.subtitle = fmt::format("seed {}, {}", options.seed, boxText(made->columns.extent));
  const survey::Drawing drawing = survey::drawSheet(made->columns, made->slice ? &*made->slice : nullptr,
                                                    survey::signsFor(*opened.program), request, made->figures);
  if (hasExtension(options.out, ".svg")) {
    file->write(survey::svgText(drawing, request.title + ", " + request.subtitle));
    if (const Result<void> written = file->commit(); !written) return reportError(written.error());
  } else if (const Result<void> written = writePng(survey::rasterise(drawing), *file); !written) {
    return reportError(written.error());
  }
  if (options.json) {
    fmt::print("{}\n", toJson(options, drawing, *made).text());
    return Exit::done;
  }
  fmt::print("{}: {}x{} pixels, {:.3g} pixels a metre, cells of {} m, {:.2f} s\n", options.out, drawing.width,
             drawing.height, made->figures.scale, metres(made->columns.step), watch.seconds());
  fmt::print("  region   {}\n", boxText(made->columns.extent));
  if (options.plan)
    fmt::print("  plan     {:.0f} m2 seen from above, heights from {:.1f} to {:.1f} m\n", made->figures.plan.area,
               made->figures.plan.lowest, made->figures.plan.highest);
  if (made->slice)
    fmt::print("  section  from {:.1f},{:.1f} to {:.1f},{:.1f} m\n", made->slice->line.x0, made->slice->line.z0,
               made->slice->line.x1, made->slice->line.z1);
  return Exit::done;
}

}  // namespace sgm::cli

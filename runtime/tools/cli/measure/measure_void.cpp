#include "tools/cli/measure/measure_void.h"

#include <fmt/core.h>

#include <algorithm>

#include "query/void_path.h"
#include "tools/cli/measure/commands.h"
#include "tools/support/region.h"

namespace sgm::cli {
namespace {

constexpr size_t kMaxVolumes = 16;

double inMetres(double units) { return units / kUnitsPerMetre; }

const char* nameOf(WayVerdict verdict) {
  switch (verdict) {
    case WayVerdict::found:
      return "found";
    case WayVerdict::from_in_rock:
      return "from_in_rock";
    case WayVerdict::to_in_rock:
      return "to_in_rock";
    case WayVerdict::from_too_narrow:
      return "from_too_narrow";
    case WayVerdict::to_too_narrow:
      return "to_too_narrow";
    case WayVerdict::apart:
      break;
  }
  return "apart";
}

/// True if the widest path is as wide as the largest radius that the search considers. Then its true radius may be
/// larger.
bool isOpenEnded(const VoidWay& way, int32_t cell) { return way.widest >= double{kMaxClearance} * cell; }

std::string widestText(const VoidWay& way, int32_t cell) {
  if (way.widest == 0) return "no agent passes, however small";
  if (isOpenEnded(way, cell)) return fmt::format("agents of radius {:.4g} m and larger pass", inMetres(way.widest));
  return fmt::format("agents of radius below {:.4g} m pass", inMetres(way.widest));
}

/// Explains in a sentence why there is no path from --from to --to.
std::string whyNot(const VoidWay& way, const MeasureOptions& options, const VoidAnswer& answer, int32_t cell) {
  const auto narrow = [&](const char* option, double clearance) {
    return fmt::format("an agent of radius {:.4g} m does not fit at {}: rock is {:.4g} m away",
                       options.radius.value_or(0), option, inMetres(clearance));
  };
  switch (way.verdict) {
    case WayVerdict::from_in_rock:
      return "--from lies in rock";
    case WayVerdict::to_in_rock:
      return "--to lies in rock";
    case WayVerdict::from_too_narrow:
      return narrow("--from", way.from_clearance);
    case WayVerdict::to_too_narrow:
      return narrow("--to", way.to_clearance);
    default:
      return fmt::format(
          "there is no path in the region: --from lies in a void of {:.4g} m3, --to in another of {:.4g} "
          "m3; {}",
          static_cast<double>(way.from_samples) * answer.sample, static_cast<double>(way.to_samples) * answer.sample,
          widestText(way, cell));
  }
}

struct Totals {
  uint64_t sealed = 0;
  double volume = 0, sealed_volume = 0;  ///< m3
};

Totals totalsOf(const VoidAnswer& answer) {
  Totals totals;
  for (const RegionVoid& v : answer.voids) {
    const double volume = static_cast<double>(v.samples) * answer.sample;
    totals.volume += volume;
    if (!v.sealed) continue;
    ++totals.sealed;
    totals.sealed_volume += volume;
  }
  return totals;
}

Json wayJson(const VoidWay& way, const MeasureOptions& options, const VoidAnswer& answer, int32_t cell) {
  const bool found = way.verdict == WayVerdict::found;
  Json places = Json::array();
  for (const Int3 place : way.places) places.push_back(metresJson(place));
  return {{"found", found},
          {"verdict", nameOf(way.verdict)},
          {"why", found ? Json() : Json(whyNot(way, options, answer, cell))},
          {"length", found ? Json(inMetres(way.length)) : Json()},
          {"widest", inMetres(way.widest)},
          {"widest_is_limit", isOpenEnded(way, cell)},
          {"from_clearance", inMetres(way.from_clearance)},
          {"to_clearance", inMetres(way.to_clearance)},
          {"from_volume", static_cast<double>(way.from_samples) * answer.sample},
          {"to_volume", static_cast<double>(way.to_samples) * answer.sample},
          {"places", places}};
}

Json toJson(const VoidAnswer& answer, const MeasureOptions& options, int32_t cell, double seconds) {
  const Totals totals = totalsOf(answer);
  Json volumes = Json::array();
  for (size_t i = 0; i < std::min(answer.voids.size(), kMaxVolumes); ++i)
    volumes.push_back(static_cast<double>(answer.voids[i].samples) * answer.sample);
  Json json = {{"file", options.file},
               {"seed", options.seed},
               {"cell", metres(cell)},
               {"region", {metresJson(answer.extent.lo), metresJson(answer.extent.hi)}},
               {"chunks", answer.chunks},
               {"seconds", seconds},
               {"radius", options.radius.value_or(0)},
               {"voids",
                {{"count", answer.voids.size()},
                 {"volume", totals.volume},
                 {"sealed", totals.sealed},
                 {"sealed_volume", totals.sealed_volume},
                 {"largest", volumes}}}};
  json["way"] = answer.way ? wayJson(*answer.way, options, answer, cell) : Json();
  return json;
}

std::string textOf(const VoidAnswer& answer, const MeasureOptions& options, int32_t cell, double seconds) {
  const Totals totals = totalsOf(answer);
  std::string text = fmt::format("{}: {} chunks, cells of {} m, an agent of radius {:.4g} m, {:.2f} s\n", options.file,
                                 answer.chunks, metres(cell), options.radius.value_or(0), seconds);
  text += fmt::format("  voids      {}, {:.6g} m3 together; {} of them sealed, {:.6g} m3\n", answer.voids.size(),
                      totals.volume, totals.sealed, totals.sealed_volume);
  if (!answer.voids.empty())
    text += fmt::format("  largest    {:.6g} m3{}\n", static_cast<double>(answer.voids[0].samples) * answer.sample,
                        answer.voids[0].sealed ? ", sealed" : "");
  if (!answer.way) return text;
  const VoidWay& way = *answer.way;
  if (way.verdict == WayVerdict::found)
    text += fmt::format("  path       {:.6g} m, {} places\n", inMetres(way.length), way.places.size());
  // If an end point lies in rock, there is no widest path to report: the error message says so.
  if (way.verdict == WayVerdict::from_in_rock || way.verdict == WayVerdict::to_in_rock) return text;
  return text + fmt::format("  widest     {}\n", widestText(way, cell));
}

Result<VoidQuestion> questionOf(const MeasureOptions& options, const IntBox& region) {
  VoidQuestion question;
  question.region = region;
  question.radius = options.radius.value_or(0) * kUnitsPerMetre;
  question.max_chunks = options.max_chunks;
  if (options.from.empty()) return question;
  const auto from = readPoint(options.from), to = readPoint(options.to);
  if (!from || !to) return Error{Code::invalid_argument, "--from and --to are points, x,y,z in metres"};
  question.ends = VoidQuestion::Ends();
  for (size_t axis = 0; axis < 3; ++axis) {
    question.ends->from[axis] = (*from)[axis] * kUnitsPerMetre;
    question.ends->to[axis] = (*to)[axis] * kUnitsPerMetre;
  }
  question.ends->widest = true;
  question.ends->tell_metres = true;
  return question;
}

}  // namespace

bool asksForVoid(const MeasureOptions& options) { return options.radius || !options.from.empty(); }

Exit measureVoid(const MeasureOptions& options) {
  OpenedWorld opened = openWorld(options);
  if (opened.program == nullptr) return opened.status;
  const Result<VoidQuestion> question = questionOf(options, opened.region);
  if (!question) return reportError(question.error());
  const Result<std::unique_ptr<JobSystem>> jobs = makeThreadPool(options.threads);
  if (!jobs) return reportError(jobs.error());
  const Stopwatch watch;
  const int32_t cell = opened.settings.finest_cell;
  if (const Result<void> few = checkChunks(options, opened.region, cell); !few) return reportError(few.error());
  const WorldField world(std::move(opened.settings), std::pmr::new_delete_resource());
  const SignField field = signField(queryField(world));
  const Result<VoidAnswer> answer = [&] {
    ProgressBar bar("looking");
    return findVoids(field, **jobs, *question, [&bar](uint64_t done, uint64_t total) {
      bar.show(done, total);
      return true;
    });
  }();
  if (!answer) return reportError(answer.error());
  const double seconds = watch.seconds();
  // If the region has too many cells to derive at once, the notes about omitted shapes are missing, which is not an
  // error.
  const Result<std::vector<DeriveNote>> notes = world.notes(answer->extent, cell);
  if (!notes && notes.error().code != Code::limit) return reportError(notes.error());
  if (notes) warnOfNotes(options.file, *notes);
  if (options.json) {
    fmt::print("{}\n", toJson(*answer, options, cell, seconds).text());
  } else {
    fmt::print("{}", textOf(*answer, options, cell, seconds));
  }
  if (!answer->way || answer->way->verdict == WayVerdict::found) return Exit::done;
  if (options.json) return Exit::input;
  std::fflush(stdout);
  return reportError(Exit::input, whyNot(*answer->way, options, *answer, cell));
}

}  // namespace sgm::cli

#include "tools/cli/picture/seed_sheet.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/json.h"
#include "tools/flight/flight_picture.h"
#include "tools/support/drawable_region.h"
#include "tools/support/ending_signals.h"
#include "tools/support/region_picture.h"
#include "tools/support/render_options.h"
#include "tools/support/source.h"
#include "tools/survey/lettering.h"
#include "tools/survey/raster.h"

namespace sgm::cli {
namespace {

constexpr int kLeastWidth = 64, kLeastHeight = 36;  // minimum size of each picture, pixels

/// The picture that the sheet shows for one seed, or the error that prevented it.
struct SeedPicture {
  uint64_t seed = 0;
  Image image;
  std::optional<Error> error;
  size_t triangles = 0;
  std::string path;  ///< path of the rule application that --frame shows, such as "net(0, 0, 0)/Node/Chamber[0]"
};

int columnsFor(size_t count) { return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))); }

/// Size of each picture on a contact sheet of size `sheet` with `columns` columns and margins between the pictures.
PictureSize pictureSize(const PictureSize& sheet, int columns) {
  constexpr int kMargins = 8;
  const int width = (sheet.width - kMargins) / columns - kMargins;
  const int height = static_cast<int>(std::lround(static_cast<double>(width) * sheet.height / sheet.width));
  return {width, height};
}

Result<void> drawSeed(const Renderer& renderer, const std::shared_ptr<const Program>& program,
                      const RenderOptions& options, SeedPicture& picture) {
  std::optional<RegionDensity> density;
  const Result<Region> region = meshProgram(program, options, picturePlan(options, density));
  if (!region) return region.error();
  if (const Result<void> drawable = checkDrawable(options, *region); !drawable) return drawable.error();
  Result<RegionPicture> drawn = drawRegion(renderer, options, *region, density);
  if (!drawn) return drawn.error();
  picture.image = std::move(drawn->image);
  picture.triangles = region->meshed.mesh.indices.size() / 3;
  if (drawn->framed) picture.path = drawn->framed->path;
  return {};
}

/// A grey picture that shows the error message as wrapped text instead of the scene.
Image failedPicture(const PictureSize& size, const Error& error) {
  constexpr uint8_t kGrey = 64;
  constexpr survey::Ink kPale{220, 200, 190};
  Image image{size.width, size.height, {}};
  image.rgba.assign(size_t{4} * static_cast<size_t>(size.width) * static_cast<size_t>(size.height), kGrey);
  for (size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  const double height = std::clamp(size.height / 26.0, 4.0, 9.0), room = size.width - 4 * height;
  std::vector<survey::Mark> marks;
  std::string line;
  double y = 3 * height;
  const auto end = [&] {
    marks.push_back(survey::lettering(line, {2 * height, y}, height, survey::Align::left, kPale));
    y += 2 * height;
    line.clear();
  };
  std::string_view left = error.message;
  while (!left.empty()) {
    const size_t length = std::min(left.find(' '), left.size());
    const std::string longer = line + (line.empty() ? "" : " ") + std::string(left.substr(0, length));
    if (!line.empty() && survey::letterWidth(longer, height) > room) end();
    line += (line.empty() ? "" : " ") + std::string(left.substr(0, length));
    left.remove_prefix(std::min(length + 1, left.size()));
  }
  end();
  survey::drawOnto(image, marks);
  return image;
}

/// Draws the seed's number into a corner: white with a dark edge, legible on every picture.
void stamp(Image& image, uint64_t seed) {
  const double height = std::clamp(image.height / 18.0, 6.0, 18.0);
  const survey::Point at{0.8 * height, image.height - 0.8 * height};
  survey::Mark letters = survey::lettering(fmt::format("{}", seed), at, height, survey::Align::left, survey::kWhite);
  letters.width = height / 7;
  survey::Mark edge = letters;
  edge.ink = survey::kBlack;
  edge.width += std::max(2.0, height / 5);
  survey::drawOnto(image, {edge, letters});
}

/// Prints each distinct error once, with all seeds that had it. Returns the exit status of the first error.
Exit tellFailures(const std::vector<SeedPicture>& pictures) {
  Exit status = Exit::done;
  std::vector<bool> told(pictures.size());
  for (size_t i = 0; i < pictures.size(); ++i) {
    if (!pictures[i].error || told[i]) continue;
    const Error& error = *pictures[i].error;
    std::vector<uint64_t> seeds;
    for (size_t j = i; j < pictures.size(); ++j) {
      if (!pictures[j].error || pictures[j].error->message != error.message) continue;
      told[j] = true;
      seeds.push_back(pictures[j].seed);
    }
    const Exit said = reportError(exitOf(error.code), fmt::format("seed{} {}: {}", seeds.size() > 1 ? "s" : "",
                                                                  fmt::join(seeds, ", "), error.message));
    if (status == Exit::done) status = said;
  }
  return status;
}

Json toJson(const RenderOptions& options, const Image& sheet, int columns, const PictureSize& size,
            const std::vector<SeedPicture>& pictures, double seconds) {
  Json seeds = Json::array();
  for (const SeedPicture& picture : pictures) {
    Json one{{"seed", picture.seed}, {"triangles", picture.triangles}};
    one["error"] = picture.error ? Json(picture.error->message) : Json(nullptr);
    if (!picture.path.empty()) one["frame"] = picture.path;
    seeds.push_back(std::move(one));
  }
  return {{"out", options.out},        {"width", sheet.width},        {"height", sheet.height},
          {"columns", columns},        {"picture_width", size.width}, {"picture_height", size.height},
          {"seeds", std::move(seeds)}, {"seconds", seconds}};
}

}  // namespace

Exit drawSeeds(const RenderOptions& options) {
  const std::vector<uint64_t> seeds = *readSeeds(options.seeds);
  const int columns = columnsFor(seeds.size());
  const PictureSize whole = *readSize(options.size), size = pictureSize(whole, columns);
  if (size.width < kLeastWidth || size.height < kLeastHeight)
    return reportError(Exit::usage,
                       fmt::format("--size: {} pictures on a sheet of {} have {}x{} pixels each, fewer than "
                                   "{}x{}: ask for a larger --size or fewer --seeds",
                                   seeds.size(), options.size, std::max(0, size.width), std::max(0, size.height),
                                   kLeastWidth, kLeastHeight));
  const Result<Renderer> renderer = Renderer::create();
  if (!renderer) return reportError(renderer.error());
  Result<FileWriter> file = FileWriter::create(options.out, &unfinished_files);
  if (!file) return reportError(file.error());
  const LoadedGrammar grammar = loadGrammar(options.file);
  if (grammar.program == nullptr) return grammar.status;

  const Stopwatch watch;
  std::vector<SeedPicture> pictures;
  std::vector<Image> images;
  for (const uint64_t seed : seeds) {
    RenderOptions one = options;
    one.seed = seed;
    one.size = fmt::format("{}x{}", size.width, size.height);
    SeedPicture& picture = pictures.emplace_back();
    picture.seed = seed;
    if (const Result<void> drawn = drawSeed(*renderer, grammar.program, one, picture); !drawn) {
      picture.error = drawn.error();
      picture.image = failedPicture(size, *picture.error);
    }
    stamp(picture.image, seed);
    images.push_back(std::move(picture.image));
  }
  const Exit status = tellFailures(pictures);
  if (std::ranges::all_of(pictures, [](const SeedPicture& picture) { return picture.error.has_value(); }))
    return status;
  const Image sheet = contactSheet(images, columns);
  if (const Result<void> written = writePng(sheet, *file); !written) return reportError(written.error());
  if (options.json) {
    fmt::print("{}\n", toJson(options, sheet, columns, size, pictures, watch.seconds()).text());
  } else {
    fmt::print("{}: {}x{} pixels, {} seeds in {} columns, {:.2f} s on {}\n", options.out, sheet.width, sheet.height,
               seeds.size(), columns, watch.seconds(), renderer->info().name);
  }
  return status;
}

}  // namespace sgm::cli

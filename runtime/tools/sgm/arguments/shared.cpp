#include "tools/sgm/arguments/shared.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "mesh/export/export.h"
#include "tools/survey/slice.h"
#include "world/chunk_key.h"

namespace sgm::cli {

CLI::Validator numberIn(double low, double high) {
  const auto check = [low, high](std::string& text) {
    double value = 0;
    if (!CLI::detail::lexical_cast(text, value) || std::isnan(value)) return fmt::format("'{}' is not a number", text);
    return value >= low && value <= high ? std::string() : fmt::format("{} is not from {:g} to {:g}", text, low, high);
  };
  return {check, fmt::format("FLOAT in [{:g} - {:g}]", low, high)};
}

std::string checkRegion(const std::string& text) {
  const size_t colon = text.find(':');
  if (colon != std::string::npos && readPoint(text.substr(0, colon)) && readPoint(text.substr(colon + 1))) return {};
  return fmt::format("'{}' is not x0,y0,z0:x1,y1,z1", text);
}

std::string checkWhole(const std::string& text) {
  uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, why] = std::from_chars(text.data(), end, value);
  return why == std::errc() && rest == end ? std::string()
                                           : fmt::format("'{}' is not a whole number from 0 to 2^64 - 1", text);
}

std::string checkSet(const std::string& text) {
  return text.find('=') == std::string::npos ? fmt::format("'{}' is not NAME=VALUE", text) : std::string();
}

std::string checkMeshFile(const std::string& out) {
  const Result<MeshFormat> format = meshFormatOf(out);
  return format ? std::string() : format.error().message;
}

std::string checkSize(const std::string& text) {
  if (readSize(text)) return {};
  return fmt::format("'{}' is not WIDTHxHEIGHT with 1 to {} pixels each", text, kMaxPicture);
}

std::string checkPoint(const std::string& text) {
  if (readPoint(text)) return {};
  return fmt::format("'{}' is not a point such as 1,2.5,-3", text);
}

std::string checkCamera(const std::string& text) {
  if (readCamera(text)) return {};
  return fmt::format("'{}' is not x,y,z:x,y,z, the position and the target in metres", text);
}

std::string checkLevels(const std::string& text) {
  return readLevels(text) ? std::string()
                          : fmt::format("'{}' is not a range of levels such as 0..4, or a single level, from 0 to {}",
                                        text, kMaxLevel);
}

std::string checkShard(const std::string& text) {
  return readShard(text) ? std::string()
                         : fmt::format("'{}' is not a shard such as 0/16 (the last one is 15/16)", text);
}

std::string checkPng(const std::string& out) {
  return hasExtension(out, ".png") ? std::string() : "pictures must be .png files";
}

std::string checkPicture(const std::string& out) {
  return hasExtension(out, ".svg") || hasExtension(out, ".png")
             ? std::string()
             : "pictures must be .png files, surveys .png or .svg files";
}

std::string checkCutLine(const std::string& text) {
  return text.empty() || survey::readCutLine(text)
             ? std::string()
             : fmt::format("'{}' is not a line X,Z:X,Z in metres between two points", text);
}

std::string checkSeeds(const std::string& text) {
  const Result<std::vector<uint64_t>> seeds = readSeeds(text);
  return seeds ? std::string() : seeds.error().message;
}

std::string checkVideo(const std::string& out) {
  const std::string extension = std::filesystem::path(out).extension().string();
  return CLI::detail::to_lower(extension) == ".mp4" ? std::string() : "videos must be .mp4 files";
}

void addLevelOption(CLI::App& app, WorldOptions& options) {
  app.add_option("--level", options.level,
                 "Level of detail: 0 is the finest, and each further level doubles the edge of the cells")
      ->check(CLI::Range(0, kMaxLevel))
      ->capture_default_str();
}

void addDerivationOptions(CLI::App& app, WorldOptions& options) {
  app.add_option("--seed", options.seed, "Seed of the world, a whole number of at least 0")
      ->check(checkWhole)
      ->capture_default_str();
  app.add_option("--set", options.sets,
                 "Set a parameter of the grammar (repeatable): a `param` line of it; sgm check --json lists them")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->check(checkSet);
  app.add_option("--backend", options.backend, "Backend that computes")
      ->check(CLI::IsMember({"auto", "cpu", "vulkan", "cuda"}))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "Number of threads; 0: one for each processor")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

void addWorldOptions(CLI::App& app, WorldOptions& options) {
  app.add_option("FILE", options.file, "The grammar, a .sgm file")->required();
  addDerivationOptions(app, options);
  app.add_flag("--json", options.json, "Print the result as one JSON object on standard output");
}

void addRegionOptions(CLI::App& app, WorldOptions& options) {
  app.add_option("--region", options.region, "Region in metres, x0,y0,z0:x1,y1,z1; it grows to whole chunks")
      ->type_name("BOX")
      ->check(checkRegion);
  CLI::Option* cell =
      app.add_option("--cell", options.cell,
                     "Edge of a sampling cell in metres (0.5; larger if a large part of an endless world is chosen)")
          ->type_name("METRES");
  app.add_option("--ld", options.density,
                 "Sampling density as in the paper, in cells per metre: the edge of a cell is 1/N m")
      ->type_name("N")
      ->excludes(cell);
  app.add_option("--max-chunks", options.max_chunks, "Refuse regions with more chunks than this")
      ->check(checkWhole)
      ->capture_default_str();
}

CLI::Option* addLightOption(CLI::App& app, std::string& light) {
  return app
      .add_option("--light", light,
                  "Light of pictures: sun, lamp (on the camera), none (uniform, without shadows), or auto, by the "
                  "share of the sky that is open to the visible surfaces")
      ->check(CLI::IsMember({"auto", "sun", "lamp", "none"}))
      ->capture_default_str();
}

std::vector<CLI::Option*> optionsBeside(CLI::App& app, const std::vector<CLI::Option*>& others) {
  std::vector<CLI::Option*> options = app.get_options([](const CLI::Option*) { return true; });
  std::erase_if(options, [&](CLI::Option* o) { return std::find(others.begin(), others.end(), o) != others.end(); });
  return options;
}

void addSandboxLimits(CLI::App& app, SandboxOptions& options) {
  app.add_option("--memory", options.memory,
                 "Limit of the memory to read and measure a mesh file, in megabytes (2^20 bytes)")
      ->check(CLI::Range(uint64_t{64}, uint64_t{1} << 24))
      ->capture_default_str();
  app.add_option("--seconds", options.seconds,
                 "Limit of the time for that in seconds, both elapsed and summed over all threads")
      ->check(numberIn(0.1, 1e6))
      ->capture_default_str();
}

void addSandboxed(CLI::App& app, SandboxOptions& options) {
  app.add_flag("--sandboxed", options.sandboxed, "Answer the process that has started this one")->group("");
}

void addSharpOption(CLI::App& app, WorldOptions& options) {
  app.add_flag(
      "--sharp", options.sharp,
      "Keep edges and corners crisp, which the cells would otherwise cut off; smooth surfaces stay as they are");
}

}  // namespace sgm::cli

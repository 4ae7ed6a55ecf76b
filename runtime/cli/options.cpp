#include "cli/options.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "api/parameter_values.h"
#include "sgm/sgm.h"

namespace sgm::cli {
namespace {

constexpr double kDefaultCell = 0.5;

Error wrong(std::string message) { return {Code::invalid_argument, std::move(message), 0, 0}; }

/// Metres to the nearest unit.
Result<int32_t> unitsOf(double metres) {
  const double units = std::floor(metres * kUnitsPerMetre + 0.5);
  if (!(units >= std::numeric_limits<int32_t>::min() && units <= std::numeric_limits<int32_t>::max()))
    return wrong(fmt::format("{} m lies outside the world of +-2097152 m", metres));
  return static_cast<int32_t>(units);
}

}  // namespace

std::optional<std::array<double, 3>> readPoint(std::string_view text) {
  std::array<double, 3> point{};
  const char* at = text.data();
  const char* end = text.data() + text.size();
  for (size_t axis = 0; axis < 3; ++axis) {
    if (axis > 0 && (at == end || *at++ != ',')) return std::nullopt;
    const auto [rest, why] = std::from_chars(at, end, point[axis]);
    if (why == std::errc::result_out_of_range) {
      point[axis] = std::numeric_limits<double>::infinity();
    } else if (why != std::errc()) {
      return std::nullopt;
    }
    at = rest;
  }
  if (at != end) return std::nullopt;
  return point;
}

std::string checkPoint(const std::string& text) {
  return readPoint(text) ? std::string() : fmt::format("'{}' is not x,y,z", text);
}

namespace {

std::string checkRegion(const std::string& text) {
  const size_t colon = text.find(':');
  if (colon != std::string::npos && readPoint(text.substr(0, colon)) && readPoint(text.substr(colon + 1))) return {};
  return fmt::format("'{}' is not x0,y0,z0:x1,y1,z1", text);
}

/// Signed text would wrap round into an unsigned number.
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

}  // namespace

void addWorldOptions(CLI::App& app, WorldOptions& options) {
  app.add_option("FILE", options.file, "The grammar, a .sgm file")->required();
  app.add_option("--seed", options.seed, "Seed of the world, a whole number from 0")
      ->check(checkWhole)
      ->capture_default_str();
  app.add_option("--set", options.sets, "Give a parameter of the grammar a value (repeatable)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->check(checkSet);
  app.add_option("--backend", options.backend, "What computes")
      ->check(CLI::IsMember({"auto", "cpu", "vulkan", "cuda"}))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "Threads to use; 0: one for each processor")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("--json", options.json, "Print the result as one JSON object on standard output");
}

void addRegionOptions(CLI::App& app, WorldOptions& options) {
  app.add_option("--region", options.region, "Region in metres, x0,y0,z0:x1,y1,z1, grown to whole chunks")
      ->type_name("BOX")
      ->check(checkRegion);
  CLI::Option* cell =
      app.add_option("--cell", options.cell, "Edge of a sampling cell in metres (0.5)")->type_name("METRES");
  app.add_option("--ld", options.density, "Sampling density of the paper: cells per metre, so a cell edge of 1/N m")
      ->type_name("N")
      ->excludes(cell);
  app.add_option("--max-chunks", options.max_chunks, "Refuse regions of more chunks than this")
      ->check(checkWhole)
      ->capture_default_str();
}

Result<IntBox> parseRegion(std::string_view text) {
  if (const std::string why = checkRegion(std::string(text)); !why.empty()) return wrong("--region: " + why);
  const size_t colon = text.find(':');
  const std::array<double, 3> lo = *readPoint(text.substr(0, colon)), hi = *readPoint(text.substr(colon + 1));
  IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<size_t>(axis);
    const Result<int32_t> low = unitsOf(lo[i]), high = unitsOf(hi[i]);
    if (!low) return wrong("--region: " + low.error().message);
    if (!high) return wrong("--region: " + high.error().message);
    if (*low >= *high) return wrong(fmt::format("--region '{}' is empty along {}", text, "xyz"[i]));
    box.lo[axis] = *low;
    box.hi[axis] = *high;
  }
  return box;
}

Result<int32_t> cellUnits(const WorldOptions& options) {
  double metres = options.cell.value_or(kDefaultCell);
  if (options.density) {
    if (!(*options.density > 0)) return wrong("--ld must be above 0");
    metres = 1 / *options.density;
  }
  int32_t units = 0;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_cell_from_metres(metres, &units, &error) != SGM_OK) return wrong(error.message);
  return units;
}

Result<ParameterValues> parameterValues(const Program& program, const std::vector<std::string>& sets) {
  ParameterValues values = ParameterValues::defaults(program);
  for (const std::string_view set : sets) {
    const size_t equals = set.find('=');
    const Result<void> ok = api::setFromText(program, set.substr(0, equals), set.substr(equals + 1), values);
    if (!ok) return wrong("--set: " + ok.error().message);
  }
  return values;
}

}  // namespace sgm::cli

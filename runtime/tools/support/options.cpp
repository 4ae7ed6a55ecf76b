#include "tools/support/options.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>

#include "api/parameter_values.h"
#include "sgm/sgm.h"
#include "world/chunk_key.h"

namespace sgm::cli {
namespace {

constexpr double kDefaultCell = 0.5;

Error wrong(std::string message) { return {Code::invalid_argument, std::move(message), 0, 0}; }

/// Converts metres to the nearest unit. Error if that is outside the world.
Result<int32_t> unitsOf(double metres) {
  const double units = std::floor(metres * kUnitsPerMetre + 0.5);
  if (!(units >= std::numeric_limits<int32_t>::min() && units <= std::numeric_limits<int32_t>::max()))
    return wrong(fmt::format("{} m lies outside the world, which reaches from -2097152 m to 2097151.999 m", metres));
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

std::optional<PictureSize> readSize(std::string_view text) {
  PictureSize size;
  const char* end = text.data() + text.size();
  const auto [x, bad_width] = std::from_chars(text.data(), end, size.width);
  if (bad_width != std::errc() || x == end || *x != 'x') return std::nullopt;
  const auto [rest, bad_height] = std::from_chars(x + 1, end, size.height);
  if (bad_height != std::errc() || rest != end) return std::nullopt;
  const auto fits = [](int pixels) { return pixels >= 1 && pixels <= kMaxPicture; };
  if (!fits(size.width) || !fits(size.height)) return std::nullopt;
  return size;
}

std::optional<std::pair<int, int>> readLevels(std::string_view text) {
  std::pair<int, int> levels;
  const char* end = text.data() + text.size();
  const auto [middle, bad_first] = std::from_chars(text.data(), end, levels.first);
  if (bad_first != std::errc()) return std::nullopt;
  levels.second = levels.first;
  if (middle != end) {
    if (end - middle < 3 || middle[0] != '.' || middle[1] != '.') return std::nullopt;
    const auto [rest, bad_last] = std::from_chars(middle + 2, end, levels.second);
    if (bad_last != std::errc() || rest != end) return std::nullopt;
  }
  if (levels.first < 0 || levels.second > kMaxLevel || levels.first > levels.second) return std::nullopt;
  return levels;
}

std::optional<std::pair<uint64_t, uint64_t>> readShard(std::string_view text) {
  std::pair<uint64_t, uint64_t> shard;
  const char* end = text.data() + text.size();
  const auto [middle, bad_number] = std::from_chars(text.data(), end, shard.first);
  if (bad_number != std::errc() || middle == end || *middle != '/') return std::nullopt;
  const auto [rest, bad_count] = std::from_chars(middle + 1, end, shard.second);
  if (bad_count != std::errc() || rest != end || shard.first >= shard.second) return std::nullopt;
  return shard;
}

std::optional<Gaze> readCamera(std::string_view text) {
  const size_t colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const std::optional<std::array<double, 3>> from = readPoint(text.substr(0, colon)),
                                             to = readPoint(text.substr(colon + 1));
  if (!from || !to) return std::nullopt;
  for (const double x : {(*from)[0], (*from)[1], (*from)[2], (*to)[0], (*to)[1], (*to)[2]})
    if (!(std::fabs(x) < 2.2e6)) return std::nullopt;
  return Gaze{*from, *to};
}

bool hasExtension(const std::string& file, std::string_view extension) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::ranges::equal(std::filesystem::path(file).extension().string(), extension, {}, small);
}

Result<std::vector<uint64_t>> readSeeds(std::string_view text) {
  const auto number = [](std::string_view digits) -> std::optional<uint64_t> {
    uint64_t value = 0;
    const char* end = digits.data() + digits.size();
    const auto [rest, why] = std::from_chars(digits.data(), end, value);
    return why == std::errc() && rest == end ? std::optional(value) : std::nullopt;
  };
  std::vector<uint64_t> seeds;
  for (std::string_view left = text;;) {
    const size_t comma = std::min(left.find(','), left.size());
    const std::string_view part = left.substr(0, comma);
    const size_t dots = part.find("..");
    const std::optional<uint64_t> first = number(part.substr(0, dots)),
                                  last = dots == part.npos ? first : number(part.substr(dots + 2));
    if (!first || !last)
      return wrong(fmt::format("'{}' is not seeds such as 1..9 or 3,7,11: whole numbers from 0", text));
    if (*first > *last) return wrong(fmt::format("'{}' runs backwards: write {}..{}", part, *last, *first));
    if (*last - *first >= kMaxSeeds - seeds.size())
      return wrong(fmt::format("'{}' has more than {} seeds, the limit of a sheet", text, kMaxSeeds));
    for (uint64_t seed = *first;; ++seed) {
      if (std::ranges::find(seeds, seed) != seeds.end())
        return wrong(fmt::format("'{}' has seed {} twice", text, seed));
      seeds.push_back(seed);
      if (seed == *last) break;
    }
    if (comma == left.size()) return seeds;
    left.remove_prefix(comma + 1);
  }
}

Result<IntBox> parseRegion(std::string_view text) {
  const size_t colon = std::min(text.find(':'), text.size());
  const auto from = readPoint(text.substr(0, colon)), to = readPoint(text.substr(std::min(colon + 1, text.size())));
  if (!from || !to) return wrong(fmt::format("--region: '{}' is not x0,y0,z0:x1,y1,z1", text));
  const std::array<double, 3>&lo = *from, &hi = *to;
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
  if (options.density && !(*options.density > 0 && std::isfinite(*options.density)))
    return wrong("--ld: the sampling density is not a finite number above 0");
  const double metres = options.density ? 1 / *options.density : options.cell.value_or(kDefaultCell);
  int32_t units = 0;
  sgm_error error = SGM_ERROR_INIT;
  if (sgm_cell_from_metres(metres, &units, &error) == SGM_OK) return units;
  if (options.density)
    return wrong(
        fmt::format("--ld: {} cells per metre are cells of {} m: {}", *options.density, metres, error.message));
  return wrong(fmt::format("--cell: {}", error.message));
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

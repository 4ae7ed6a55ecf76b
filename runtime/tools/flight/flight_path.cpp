#include "tools/flight/flight_path.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "base/file_reader.h"

namespace sgm::cli {
namespace {

constexpr double kFarthest = 2e6;       // maximum distance of a point from the world's origin on each axis, metres
constexpr double kFinest = 0.25;        // distance between the resampled places of a curve, metres
constexpr double kMaxPlaces = 1 << 20;  // maximum number of resampled places of a path from a file
constexpr size_t kMaxPathBytes = size_t{64} << 20;

Error wrong(const std::string& what) { return {Code::invalid_argument, what}; }

Error notJson(std::string_view text, size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte == 0 ? 0 : byte - 1, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const size_t column = before.size() - (before.rfind('\n') == before.npos ? 0 : before.rfind('\n') + 1) + 1;
  return {Code::bad_input, "this is not JSON", static_cast<int>(line), static_cast<int>(column)};
}

Result<Metres3> readPathPoint(const nlohmann::json& json, const std::string& name) {
  if (!json.is_array() || json.size() != 3) return wrong(name + " is not [x, y, z]");
  Metres3 point{0};
  for (int axis = 0; axis < 3; ++axis) {
    const nlohmann::json& value = json[static_cast<size_t>(axis)];
    if (!value.is_number()) return wrong(name + " must be three numbers");
    point[axis] = value.get<double>();
    if (!(std::fabs(point[axis]) <= kFarthest)) return wrong(name + " is farther than 2,000 km from the origin");
  }
  return point;
}

}  // namespace

Result<PathPoints> readPathPoints(std::string_view text) {
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    return notJson(text, error.byte);
  } catch (const nlohmann::json::out_of_range&) {
    return wrong("a number is too large");
  }
  if (!json.is_object()) return wrong("a path must be an object, {\"points\": [[x, y, z], ...]}");
  for (const auto& [name, value] : json.items())
    if (name != "points" && name != "loop")
      return wrong("a path may have \"points\" and \"loop\", but not \"" + name + "\"");
  PathPoints path;
  if (json.contains("loop")) {
    if (!json["loop"].is_boolean()) return wrong("\"loop\" must be true or false");
    path.loop = json["loop"].get<bool>();
  }
  if (!json.contains("points") || !json["points"].is_array()) return wrong("a path must have a list of \"points\"");
  const nlohmann::json& points = json["points"];
  for (size_t i = 0; i < points.size(); ++i) {
    const Result<Metres3> point = readPathPoint(points[i], "points[" + std::to_string(i) + "]");
    if (!point) return point.error();
    if (path.points.empty() || path.points.back() != *point) path.points.push_back(*point);
  }
  if (path.loop && path.points.size() > 1 && path.points.back() == path.points.front()) path.points.pop_back();
  if (path.points.size() < 2) return wrong("a path must have at least two different points");
  return path;
}

Result<FlightPath> FlightPath::ofFile(const std::string& file) {
  const Result<std::string> read = readFile(file, kMaxPathBytes, Readable::all_but_folders);
  if (!read && read.error().code == Code::limit)
    return Error{Code::limit, file + ": the file is larger than 64 MiB, the limit of a path"};
  if (!read) return read.error();
  const std::string& text = *read;
  const Result<PathPoints> path = readPathPoints(text);
  if (path) return through(*path);
  Error error = path.error();
  std::string place = file + ": ";
  if (error.line > 0) place = file + ":" + std::to_string(error.line) + ":" + std::to_string(error.column) + ": ";
  error.message.insert(0, place);
  return error;
}

FlightPath FlightPath::through(const PathPoints& path) {
  const auto lengthAlong = [](const std::vector<Metres3>& points) {
    double length = 0;
    for (size_t i = 1; i < points.size(); ++i) length += glm::length(points[i] - points[i - 1]);
    return length;
  };
  const double finest = std::max(kFinest, lengthAlong(path.points) / kMaxPlaces);
  const std::vector<Metres3> points = splinePoints(path.points, finest / 2, path.loop);
  // Choose the spacing such that the length is a whole number of spacings. The length is reduced slightly, so that
  // rounding errors cannot lose the last place or open a loop.
  const double length = (1 - 1e-9) * lengthAlong(points);
  FlightPath flight(length / std::max(1.0, std::round(length / finest)));
  flight.loop_ = path.loop;
  flight.curve_.extend(points);
  return flight;
}

Result<FlightPath> FlightPath::automatic(sgm_field* field, const sgm_grammar* grammar, const AutoFlight& settings) {
  Result<FlightPlanner> planner = FlightPlanner::begin(field, grammar, settings);
  if (!planner) return planner.error();
  FlightPath flight(planner->spacing());
  flight.planner_.emplace(std::move(*planner));
  return flight;
}

Result<FlightPlace> FlightPath::at(double s) {
  // The direction at a place depends on the next places, so plan slightly beyond s.
  while (planner_ && curve_.length() < s + 2 * planner_->spacing()) {
    const Result<std::vector<Metres3>> piece = planner_->next();
    if (!piece) return piece.error();
    curve_.extend(*piece);
  }
  return curve_.at(loop_ && s > curve_.length() ? std::fmod(s, curve_.length()) : s);
}

std::optional<double> FlightPath::length() const {
  if (planner_ || loop_) return {};
  return curve_.length();
}

Result<void> FlightPath::teleport(uint64_t number) {
  if (!planner_) return Error{Code::unsupported, "a path from a file has no places to leap to"};
  if (Result<void> ok = planner_->teleport(number); !ok) return ok.error();
  curve_ = FlightCurve(planner_->spacing());
  return {};
}

}  // namespace sgm::cli

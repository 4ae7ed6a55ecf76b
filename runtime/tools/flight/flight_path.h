#pragma once
// The path of a flight: through the points of a file, or planned through the void of a field.

#include <optional>
#include <string>
#include <string_view>

#include "tools/flight/flight_planner.h"

namespace sgm::cli {

/// The contents of a path file, {"points": [[x, y, z], ...], "loop": true}, in metres. If loop is missing, it is false.
struct PathPoints {
  std::vector<Metres3> points;  ///< two or more; neighbours differ
  bool loop = false;
};

/// Parses a path file. Errors, each in one line: bad_input with line and column for invalid JSON, invalid_argument for
/// any other invalid content.
Result<PathPoints> readPathPoints(std::string_view json);

/// Not thread-safe.
class FlightPath {
 public:
  /// A smooth curve through the points of a file. Errors: io, those of readPathPoints(); the message begins with the
  /// file's name.
  static Result<FlightPath> ofFile(const std::string& file);
  static FlightPath through(const PathPoints& path);
  /// An endless path, planned during the flight. Field and grammar must outlive it. Errors: as FlightPlanner::begin().
  static Result<FlightPath> automatic(sgm_field* field, const sgm_grammar* grammar, const AutoFlight& settings);

  /// The place at arc length s >= 0, in metres. Plans the path up to there if necessary, which is slow. Beyond the end
  /// of a path, the place is its end; a loop starts again. Errors: as FlightPlanner::next().
  Result<FlightPlace> at(double s);
  /// Length in metres; nullopt for an endless path.
  std::optional<double> length() const;
  /// Continues from another place (FlightPlanner::teleport), from which s is then measured. Error: unsupported for a
  /// path from a file.
  Result<void> teleport(uint64_t number);

 private:
  explicit FlightPath(double spacing) : curve_(spacing) {}

  FlightCurve curve_;
  bool loop_ = false;
  std::optional<FlightPlanner> planner_;
};

}  // namespace sgm::cli

#pragma once
// The path of a flight: along the points of a file, or planned through the void of a field.

#include <optional>
#include <string>
#include <string_view>

#include "tools/flight/flight_planner.h"

namespace sgm::cli {

/// The points of a path file, {"points": [[x, y, z], ...], "loop": true}, in metres. loop may be missing: false.
struct PathPoints {
  std::vector<Metres3> points;  ///< two or more; neighbours differ
  bool loop = false;
};

/// Errors, each one line: bad_input with line and column for wrong JSON, invalid_argument for any other wrong content.
Result<PathPoints> readPathPoints(std::string_view json);

/// One thread at a time.
class FlightPath {
 public:
  /// The smooth curve through the points of a file. Errors: io, those of readPathPoints, after the file's name.
  static Result<FlightPath> ofFile(const std::string& file);
  static FlightPath through(const PathPoints& path);
  /// An endless flight that plans its own path. Field and grammar must outlive it. Errors: as FlightPlanner.
  static Result<FlightPath> automatic(sgm_field* field, const sgm_grammar* grammar, const AutoFlight& settings);

  /// The place at arc length s >= 0, in metres. May plan up to there, which is slow. Beyond its end, a path stays
  /// there; a loop starts again. Errors: as FlightPlanner::next.
  Result<FlightPlace> at(double s);
  /// nullopt for an endless path.
  std::optional<double> length() const;
  /// Continues from another place (FlightPlanner::teleport), where s restarts at 0. Error: unsupported for a path of a
  /// file.
  Result<void> teleport(uint64_t number);

 private:
  explicit FlightPath(double spacing) : curve_(spacing) {}

  FlightCurve curve_;
  bool loop_ = false;
  std::optional<FlightPlanner> planner_;
};

}  // namespace sgm::cli

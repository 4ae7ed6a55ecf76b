#pragma once
// Where a flight goes: along the points of a file, or on its own through the void of a field.

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

/// Errors: bad_input with line and column (not JSON), invalid_argument (anything else that is no path), each one line.
Result<PathPoints> readPathPoints(std::string_view json);

/// One thread at a time.
class FlightPath {
 public:
  /// The smooth curve through the points of a file. Errors: io, those of readPathPoints, after the file's name.
  static Result<FlightPath> ofFile(const std::string& file);
  static FlightPath through(const PathPoints& path);
  /// A flight without an end that finds its own way. Field and grammar must outlive it. Errors: as FlightPlanner.
  static Result<FlightPath> automatic(sgm_field* field, const sgm_grammar* grammar, const AutoFlight& settings);

  /// The place at arc length s >= 0, in metres; plans as far as that where it must, which takes its time. Beyond its
  /// end a path stands still; a loop begins anew. Errors: as FlightPlanner::next.
  Result<FlightPlace> at(double s);
  /// Nothing for a path that goes on for ever.
  std::optional<double> length() const;
  /// Goes on from another place (FlightPlanner::teleport), from where s counts anew. unsupported: a path of a file.
  Result<void> teleport(uint64_t number);

 private:
  explicit FlightPath(double spacing) : curve_(spacing) {}

  FlightCurve curve_;
  bool loop_ = false;
  std::optional<FlightPlanner> planner_;
};

}  // namespace sgm::cli

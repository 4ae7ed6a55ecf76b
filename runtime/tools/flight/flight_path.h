#pragma once
// The path of a flight: a curve through the points of a file, or a path planned through the void of a field.

#include <optional>
#include <string>
#include <string_view>

#include "tools/flight/flight_planner.h"

namespace sgm::cli {

/// The contents of a path file, {"points": [[x, y, z], ...], "loop": true}, in metres. If "loop" is missing, it is
/// false.
struct PathPoints {
  std::vector<Metres3> points;  ///< at least two points; neighbouring points differ
  bool loop = false;
};

/// Parses a path file. Errors, each in one line: bad_input with line and column for invalid JSON, invalid_argument for
/// any other invalid content.
Result<PathPoints> readPathPoints(std::string_view json);

/// A path along which a viewer flies, parametrized by arc length. Not thread-safe.
class FlightPath {
 public:
  /// A smooth curve through the points of a file. Errors: io; those of readPathPoints(), with the file's name at the
  /// beginning of the message.
  static Result<FlightPath> ofFile(const std::string& file);
  static FlightPath through(const PathPoints& path);
  /// An endless path, planned while the flight proceeds. Field and grammar must outlive the path. Errors: those of
  /// FlightPlanner::begin().
  static Result<FlightPath> automatic(sgm_field* field, const sgm_grammar* grammar, const AutoFlight& settings);

  /// The place at arc length s >= 0, in metres. If necessary, plans the path up to there, which is slow. Beyond the end
  /// of a path, returns its end; a loop starts again. Errors: those of FlightPlanner::next().
  Result<FlightPlace> at(double s);
  /// Length in metres; nullopt for a planned path or a loop, which have no end.
  std::optional<double> length() const;
  /// Continues the path at another place (FlightPlanner::teleport), where s starts at 0 again. Error: unsupported for a
  /// path from a file.
  Result<void> teleport(uint64_t number);

 private:
  explicit FlightPath(double spacing) : curve_(spacing) {}

  FlightCurve curve_;
  bool loop_ = false;
  std::optional<FlightPlanner> planner_;
};

}  // namespace sgm::cli

#pragma once
// Animates a grammar's parameters while a world streams, as a game does with a tide or a slider.

#include <sgm/sgm.h>

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

/// Moves each animated parameter through its range and back within ten seconds, with ten updates per second. Not
/// thread-safe.
class FlightAnimation {
 public:
  /// names: the parameters to animate; empty: all that the grammar declares animated. field: description of the world's
  /// current field, with the initial parameters. All arguments must outlive the animation. Errors: invalid_argument if
  /// there is no parameter to animate, or a parameter has no range.
  static Result<FlightAnimation> of(sgm_runtime* runtime, const sgm_field_desc& field, sgm_parameters* parameters,
                                    const std::vector<std::string>& names);

  /// Passes a field with new parameter values to the world if an update is due. Errors: those of the public interface.
  Result<void> show(sgm_world* world, double seconds);

  uint64_t fields() const { return fields_; }
  /// Number of fields that were passed to the world and have been drawn since, as far as show() has observed.
  uint64_t drawn() const { return drawn_; }

 private:
  struct Driven {
    std::string name;
    double low = 0, high = 0;
    bool whole = false;
  };

  FlightAnimation(sgm_runtime* runtime, const sgm_field_desc& field, sgm_parameters* parameters)
      : runtime_(runtime), field_(field), parameters_(parameters) {}

  sgm_runtime* runtime_;
  sgm_field_desc field_;
  sgm_parameters* parameters_;
  std::vector<Driven> driven_;
  uint64_t fields_ = 0, drawn_ = 0, last_drawn_ = 0;
};

}  // namespace sgm::cli

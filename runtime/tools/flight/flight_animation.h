#pragma once
// Drives a grammar's parameters while a world streams, as a game does with a tide or a slider.

#include <sgm/sgm.h>

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"

namespace sgm::cli {

/// Each parameter through its range, there and back in ten seconds, ten times a second. One thread at a time.
class FlightAnimation {
 public:
  /// Of the parameters named; none: of all that the grammar declares animated. field: what the world has; its
  /// parameters are those to begin with. All of them must outlive the animation. Errors: invalid_argument, where there
  /// is nothing to drive, or no range to drive it through.
  static Result<FlightAnimation> of(sgm_runtime* runtime, const sgm_field_desc& field, sgm_parameters* parameters,
                                    const std::vector<std::string>& names);

  /// The field of that moment, where it is time for one. Errors: those of the public interface.
  Result<void> show(sgm_world* world, double seconds);

  uint64_t fields() const { return fields_; }
  /// How many of them were drawn, as far as show() has seen.
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

#pragma once
// The panel of the preview window: the user's controls, and messages.

#include <optional>
#include <string>
#include <vector>

#include "tools/preview/painter.h"
#include "tools/support/render_options.h"

namespace sgm::preview {

/// The values that the user has set in the panel; the window requests a picture with these values.
class Controls {
 public:
  explicit Controls(const cli::RenderOptions& options);

  /// Shows controls for a program's parameters. Values that the user has set stay if they are valid for the new
  /// program.
  void adopt(const std::shared_ptr<const Program>& program);
  /// Draws the panel; must be called within a Dear ImGui frame. Returns whether the user has changed a value.
  bool draw(const Painted& last, bool at_work);

  uint64_t seed() const { return seed_; }
  /// The chosen light, in the form of --light.
  std::string light() const;
  /// Assignments in the form of --set: all parameters that differ from their defaults, and the assignments of the
  /// command line for which the program has no parameter.
  std::vector<std::string> sets() const;

 private:
  bool drawParameter(const Param& param, double& value) const;

  uint64_t seed_;
  int light_ = 0;
  std::vector<std::string> given_;  ///< assignments of --set on the command line
  std::shared_ptr<const Program> program_;
  std::vector<double> values_;  ///< one for each of Program::params
};

}  // namespace sgm::preview

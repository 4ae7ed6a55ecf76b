#pragma once
// The panel of a preview: the user's controls, and messages.

#include <optional>
#include <string>
#include <vector>

#include "tools/preview/painter.h"
#include "tools/support/render_options.h"

namespace sgm::preview {

/// The values in the panel; the window requests a picture with them.
class Controls {
 public:
  explicit Controls(const cli::RenderOptions& options);

  /// Adopts a program's declarations. The user's values stay if they still fit.
  void adopt(const std::shared_ptr<const Program>& program);
  /// To be called in a Dear ImGui frame. Returns whether a value has changed.
  bool draw(const Painted& last, bool at_work);

  uint64_t seed() const { return seed_; }
  /// The chosen light, as for --light.
  std::string light() const;
  /// In the form of --set: parameters that differ from their defaults, and settings of the command line for which the
  /// program has no parameter.
  std::vector<std::string> sets() const;

 private:
  bool drawParameter(const Param& param, double& value) const;

  uint64_t seed_;
  int light_ = 0;
  std::vector<std::string> given_;  ///< of the command line
  std::shared_ptr<const Program> program_;
  std::vector<double> values_;  ///< by Program::params
};

}  // namespace sgm::preview

#pragma once
// The panel of the preview window, with controls for the user and messages.

#include <optional>
#include <string>
#include <vector>

#include "tools/preview/painter.h"
#include "tools/support/render_options.h"

namespace sgm::preview {

/// The control panel, and the values that the user has set in it. The next picture is requested with these values.
class Controls {
 public:
  explicit Controls(const cli::RenderOptions& options);

  /// Adds controls for the parameters of a program. Values that the user has set are kept; a value that is not valid
  /// for this program is kept as text, in case it becomes valid again.
  void adopt(const std::shared_ptr<const Program>& program);
  /// Draws the panel; must be called within a Dear ImGui frame. Returns true if the user has changed a value.
  bool draw(const Painted& last, bool at_work);

  uint64_t seed() const { return seed_; }
  /// The light that the user has chosen, as a value of --light.
  std::string light() const;
  /// Returns values of --set: assignments of all parameters that differ from their defaults, and the earlier
  /// assignments that are not valid for the current program.
  std::vector<std::string> sets() const;

 private:
  bool drawParameter(const Param& param, double& value) const;

  uint64_t seed_;
  int light_ = 0;
  std::vector<std::string> given_;  ///< assignments NAME=VALUE (from --set or from the controls) that are not valid for
                                    ///< the current program; they may be valid again after its next change
  std::shared_ptr<const Program> program_;
  std::vector<double> values_;  ///< values of the parameters, in the order of Program::params
};

}  // namespace sgm::preview

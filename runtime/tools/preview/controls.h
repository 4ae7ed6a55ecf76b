#pragma once
// The panel of a preview: what a user sets, and what is said.

#include <optional>
#include <string>
#include <vector>

#include "tools/preview/painter.h"
#include "tools/support/render_options.h"

namespace sgm::preview {

/// The values that the panel shows; the window asks for a picture with them.
class Controls {
 public:
  explicit Controls(const cli::RenderOptions& options);

  /// Takes over what a program declares. Values that a user has set stay, where they still fit.
  void adopt(const std::shared_ptr<const Program>& program);
  /// Within a frame of Dear ImGui. Returns whether a value has changed.
  bool draw(const Painted& last, bool at_work);

  uint64_t seed() const { return seed_; }
  /// --light's name of what is chosen.
  std::string light() const;
  /// As --set takes them: of parameters that differ from their defaults, and those of the command line that no
  /// parameter of the program takes.
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

#pragma once
// Options of `sgm render` and `sgm preview`.

#include <optional>
#include <string>

#include "tools/support/options.h"

namespace sgm::cli {

struct RenderOptions : WorldOptions {
  std::string out;
  std::string camera;
  std::string at;
  std::string size = "1280x720";
  double fov = 68;
  /// Maximal size of a grid cell in the picture, in pixels; cells are made smaller to satisfy it.
  std::optional<double> pixels;
  std::string light = "auto";  ///< sun, lamp, none, or auto, which measures how much sky is visible
  bool volume = false;         ///< draws the solid as fog instead of its surface
  bool wires = false;          ///< also draws the mesh's edges, and no materials
  std::string frame;           ///< a rule or a path of rule uses, one of which the camera shows; empty: none
  std::string seeds;  ///< seeds of a contact sheet, in the form of readSeeds(); empty: one picture with the seed `seed`
  bool plan = false;  ///< draws the plan of a survey instead of a picture
  /// Draws a long section: "" chooses its line, otherwise the line in the form of survey::readCutLine().
  std::optional<std::string> section;
};

}  // namespace sgm::cli

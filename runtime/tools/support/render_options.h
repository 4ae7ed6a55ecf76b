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
  /// Maximum size, in pixels, that a grid cell may have in the picture. If necessary, a smaller cell edge is chosen.
  std::optional<double> pixels;
  std::string light = "auto";  ///< sun, lamp or none; auto: sun or lamp, depending on how much sky is visible
  bool volume = false;         ///< whether the solid is drawn as fog instead of its surface
  bool wires = false;          ///< whether the mesh's edges are drawn, on a surface without materials
  /// name of a rule, or path of rule uses: the camera shows a use that matches; empty: the camera is not placed by rule
  std::string frame;
  std::string seeds;  ///< seeds of a contact sheet, as for readSeeds(); empty: one picture
  bool plan = false;  ///< whether a survey's plan (map) is drawn instead of a picture
  /// If set, a survey's section is drawn along this line, as for survey::readCutLine(). If empty, the line is chosen
  /// automatically.
  std::optional<std::string> section;
};

}  // namespace sgm::cli

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
  /// Maximum size of a grid cell in the picture, in pixels. Cells are made smaller to meet it.
  std::optional<double> pixels;
  std::string light = "auto";  ///< sun, lamp or none; auto: sun or lamp, depending on how much sky is visible
  bool volume = false;         ///< whether the solid is drawn as fog instead of its surface
  bool wires = false;          ///< whether the mesh's edges are drawn, on a surface without materials
  std::string frame;           ///< rule, or path of rule uses; the camera shows one of its uses; empty: none
  std::string seeds;           ///< seeds of a contact sheet, as for readSeeds(); empty: one picture
  bool plan = false;           ///< whether a survey's plan is drawn instead of a picture
  /// If set, a survey's section is drawn along this line, as for survey::readCutLine(). If empty, the line is chosen
  /// automatically.
  std::optional<std::string> section;
};

}  // namespace sgm::cli

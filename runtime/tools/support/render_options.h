#pragma once
// What `sgm render` and `sgm preview` are asked.

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
  std::optional<double> pixels;        ///< how wide a cell may look, where that asks for smaller ones
  std::string light = "auto";          ///< sun, lamp, none, or auto: what the camera sees decides
  bool volume = false;                 ///< the solid as fog instead of its surface
  bool wires = false;                  ///< the mesh's edges, without materials
  std::string frame;                   ///< a rule, or a path of uses, one of which the camera shows; empty: none
  std::string seeds;                   ///< of a contact sheet, as readSeeds takes them; empty: one picture of `seed`
  bool plan = false;                   ///< a survey's plan in place of a picture
  std::optional<std::string> section;  ///< a long section: "" or as survey::readCutLine takes it
};

}  // namespace sgm::cli

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
  std::optional<double> pixels;        ///< maximal size of a cell in the picture, which may make cells smaller
  std::string light = "auto";          ///< sun, lamp, none, or auto: chosen by what the camera sees
  bool volume = false;                 ///< draws the solid as fog instead of its surface
  bool wires = false;                  ///< the mesh's edges, without materials
  std::string frame;                   ///< a rule or a path of uses, of which the camera shows one use; empty: none
  std::string seeds;                   ///< of a contact sheet, as for readSeeds; empty: one picture of `seed`
  bool plan = false;                   ///< a survey's plan instead of a picture
  std::optional<std::string> section;  ///< a long section: "" or as survey::readCutLine takes it
};

}  // namespace sgm::cli

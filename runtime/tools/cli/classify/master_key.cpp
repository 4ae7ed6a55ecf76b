#include "tools/cli/classify/master_key.h"

#include <fmt/core.h>

namespace sgm::cli {

std::string textOf(const measure::MasterKey& key) {
  std::string text = fmt::format("mode {}, {} bins", measure::nameOf(key.mode), key.bins);
  if (key.length > 0) text += fmt::format(", curvature length {:.6g} m", key.length);
  text += key.density > 0 ? fmt::format(", {:.6g} cells per metre", key.density) : ", any density";
  return text;
}

Json toJson(const measure::MasterKey& key) {
  return {{"bins", key.bins},
          {"mode", measure::nameOf(key.mode)},
          {"curvature_length", key.length > 0 ? Json(key.length) : Json(nullptr)},
          {"density", key.density > 0 ? Json(key.density) : Json(nullptr)},
          {"normals", "smooth, outward"},
          {"version", key.version}};
}

}  // namespace sgm::cli

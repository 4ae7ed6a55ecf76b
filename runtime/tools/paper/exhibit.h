#pragma once
// A figure or table of the paper in the report: the printed one, and our reproduction.

#include <string>
#include <vector>

#include "base/json.h"
#include "tools/paper/html.h"

namespace sgm::cli {

struct Exhibit {
  std::string id;                     ///< "figure-7": referred to by contradictions
  std::string title;                  ///< "Figure 7. Clouds"
  std::vector<std::string> printed;   ///< quoted from its caption and text
  Markup ours;                        ///< pictures, charts and tables, with explanations
  std::string measured;               ///< the method, in a sentence or two
  std::vector<std::string> commands;  ///< that repeat only this one
  Json numbers;                       ///< an object
};

}  // namespace sgm::cli

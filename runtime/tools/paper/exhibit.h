#pragma once
// One figure or table of the paper in the report: what it prints, and ours beside.

#include <string>
#include <vector>

#include "base/json.h"
#include "tools/paper/html.h"

namespace sgm::cli {

struct Exhibit {
  std::string id;                     ///< "figure-7": the place that contradictions name
  std::string title;                  ///< "Figure 7. Clouds"
  std::vector<std::string> printed;   ///< quoted from its caption and text
  Markup ours;                        ///< pictures, charts, tables, and what they show
  std::string measured;               ///< how, a sentence or two
  std::vector<std::string> commands;  ///< that repeat it alone
  Json numbers;                       ///< an object
};

}  // namespace sgm::cli

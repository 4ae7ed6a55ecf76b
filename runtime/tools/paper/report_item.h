#pragma once
// One figure or table of the paper in the report: the printed one, and our reproduction of it.

#include <string>
#include <vector>

#include "base/json.h"
#include "tools/paper/html.h"

namespace sgm::cli {

struct ReportItem {
  std::string id;                     ///< name such as "figure-7", to which Contradiction::places refers
  std::string title;                  ///< "Figure 7. Clouds"
  std::vector<std::string> printed;   ///< quotations from the figure's caption and the paper's text
  Markup ours;                        ///< our reproduction: pictures, charts and tables, with explanations
  std::string measured;               ///< the method, in a sentence or two
  std::vector<std::string> commands;  ///< commands that repeat only this figure or table
  Json numbers;                       ///< the measured numbers, as a JSON object
};

}  // namespace sgm::cli

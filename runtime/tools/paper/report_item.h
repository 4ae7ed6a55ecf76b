#pragma once
// One figure or table in the report: the text printed in the paper, and our reproduction.

#include <string>
#include <vector>

#include "base/json.h"
#include "tools/paper/html.h"

namespace sgm::cli {

struct ReportItem {
  std::string id;                     ///< identifier such as "figure-7", which Contradiction::places also uses
  std::string title;                  ///< "Figure 7. Clouds"
  std::vector<std::string> printed;   ///< quotations from the paper: the caption of the figure, and related text
  Markup ours;                        ///< our reproduction: pictures, charts and tables, with explanations
  std::string measured;               ///< description of how the numbers were measured, in a sentence or two
  std::vector<std::string> commands;  ///< commands that repeat only this figure or table
  Json numbers;                       ///< the measured numbers, as a JSON object
};

}  // namespace sgm::cli

#pragma once
// Writes the report as one HTML page with pictures, which needs neither network nor scripts.

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tools/paper/report_item.h"

namespace sgm::cli {

struct ReportFacts {
  std::vector<std::pair<std::string, std::string>> machine;  ///< name and value of each property of the machine
  bool quick = false;
  bool pictures = true;
  bool whole = true;  ///< true if the report includes all parts
};

std::string reportPage(const ReportFacts& facts, std::span<const ReportItem> report_items);

}  // namespace sgm::cli

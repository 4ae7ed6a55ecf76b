#pragma once
// The report as one page that needs nothing beside its pictures: no network, no script.

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tools/paper/exhibit.h"

namespace sgm::cli {

struct ReportFacts {
  std::vector<std::pair<std::string, std::string>> machine;  ///< what made it: a name and what it is
  bool quick = false;
  bool pictures = true;
  bool whole = true;  ///< not of some parts alone
};

std::string reportPage(const ReportFacts& facts, std::span<const Exhibit> exhibits);

}  // namespace sgm::cli

#pragma once
// The parts of the report, and the functions that make them independently of each other.

#include <vector>

#include "base/result.h"
#include "tools/paper/report_item.h"

namespace sgm::cli {

class ReportContext;

using ReportItems = Result<std::vector<ReportItem>>;

ReportItems speedupPart(ReportContext& report_context);       ///< figures 1 and 2, tables 1 to 3
ReportItems cloudPart(ReportContext& report_context);         ///< figure 7
ReportItems cavePart(ReportContext& report_context);          ///< figure 8
ReportItems architecturePart(ReportContext& report_context);  ///< figure 9
ReportItems densityPart(ReportContext& report_context);       ///< figures 10 and 11
ReportItems objectsPart(ReportContext& report_context);       ///< figure 12
ReportItems histogramsPart(ReportContext& report_context);    ///< figures 14 and 15
ReportItems timePart(ReportContext& report_context);          ///< figure 16
ReportItems comparisonPart(ReportContext& report_context);    ///< table 4

struct Part {
  const char* name;
  ReportItems (*make)(ReportContext& report_context);
};
inline constexpr Part kParts[] = {
    {"speedup", speedupPart},           {"cloud", cloudPart},     {"cave", cavePart},
    {"architecture", architecturePart}, {"density", densityPart}, {"objects", objectsPart},
    {"histograms", histogramsPart},     {"time", timePart},       {"comparison", comparisonPart},
};

}  // namespace sgm::cli

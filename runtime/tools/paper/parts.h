#pragma once
// Functions that make the parts of the report. Each part can be made separately.

#include <vector>

#include "base/result.h"
#include "tools/paper/exhibit.h"

namespace sgm::cli {

class Workshop;

using Exhibits = Result<std::vector<Exhibit>>;

Exhibits speedupPart(Workshop& workshop);       ///< figures 1 and 2, tables 1 to 3
Exhibits cloudPart(Workshop& workshop);         ///< figure 7
Exhibits cavePart(Workshop& workshop);          ///< figure 8
Exhibits architecturePart(Workshop& workshop);  ///< figure 9
Exhibits densityPart(Workshop& workshop);       ///< figures 10 and 11
Exhibits objectsPart(Workshop& workshop);       ///< figure 12
Exhibits histogramsPart(Workshop& workshop);    ///< figures 14 and 15
Exhibits timePart(Workshop& workshop);          ///< figure 16
Exhibits comparisonPart(Workshop& workshop);    ///< table 4

struct Part {
  const char* name;
  Exhibits (*make)(Workshop& workshop);
};
inline constexpr Part kParts[] = {
    {"speedup", speedupPart},           {"cloud", cloudPart},     {"cave", cavePart},
    {"architecture", architecturePart}, {"density", densityPart}, {"objects", objectsPart},
    {"histograms", histogramsPart},     {"time", timePart},       {"comparison", comparisonPart},
};

}  // namespace sgm::cli

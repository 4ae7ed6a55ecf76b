#include "cli/paper.h"

#include <fmt/core.h>

#include <algorithm>

namespace sgm::cli {
namespace {

/// "1.0, 2.0 and 3.0" of the stages.
template <class Value>
std::string ofEach(int decimals, Value value) {
  return fmt::format("{:.{}f}, {:.{}f} and {:.{}f}", value(kPaperStages[0]), decimals, value(kPaperStages[1]), decimals,
                     value(kPaperStages[2]), decimals);
}

}  // namespace

std::vector<std::string> paperInconsistencies() {
  const double ratio = kPaperParallelThroughput / kPaperSequentialThroughput;
  const auto speedups = ofEach(2, [](const PaperStage& s) { return s.speedup(); });
  const auto [least, most] =
      std::minmax_element(kPaperStages.begin(), kPaperStages.end(),
                          [](const PaperStage& a, const PaperStage& b) { return a.speedup() < b.speedup(); });
  return {
      fmt::format("Table 2 does not follow from table 1. Its times give speedups of {}, and over {} workers "
                  "efficiencies of {}; printed are {}, which is more than rounding. They would take {} workers: no one "
                  "number fits.",
                  speedups, kPaperWorkers,
                  ofEach(4, [](const PaperStage& s) { return efficiency(s.speedup(), kPaperWorkers); }),
                  ofEach(3, [](const PaperStage& s) { return s.efficiency; }),
                  ofEach(0, [](const PaperStage& s) { return s.speedup() / s.efficiency; })),
      fmt::format(
          "Table 3 does not follow from table 1. {} / {} is {:.1f} times the throughput, at speedups of {:.1f} to "
          "{:.1f}: by equation 4 the parallel program did {} times the operations. One figure stands for three "
          "stages.",
          kPaperParallelThroughput, kPaperSequentialThroughput, ratio, least->speedup(), most->speedup(),
          ofEach(1, [ratio](const PaperStage& s) { return ratio / s.speedup(); })),
      "Table 1 is headed speedup and holds seconds; the delay that the text announces is in none of the tables. The "
      "speedup is cited as equation 4, and is equation 2.",
      fmt::format("m = {} is said nowhere else: of what, on which device.", kPaperWorkers),
      "Two machines: an Intel T2300 with a GTX 460 in section 3, an i7-2630QM with a GTX 460M in section 8.",
      "Section 5 cannot measure the time of the algorithm that works on shapes; the tables do not say which part of "
      "the "
      "work they time, nor how large the models are.",
      "Equation 3 holds efficiency below 1, and the text calls 1 the ideal case.",
  };
}

}  // namespace sgm::cli

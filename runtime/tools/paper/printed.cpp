#include "tools/paper/printed.h"

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

std::vector<Contradiction> contradictions() {
  const double ratio = kPaperParallelThroughput / kPaperSequentialThroughput;
  const auto speedups = ofEach(2, [](const PaperStage& s) { return s.speedup(); });
  const auto [least, most] =
      std::minmax_element(kPaperStages.begin(), kPaperStages.end(),
                          [](const PaperStage& a, const PaperStage& b) { return a.speedup() < b.speedup(); });
  return {
      {fmt::format(
           "Table 2 does not follow from table 1. Its times give speedups of {}, and over {} workers "
           "efficiencies of {}; printed are {}, which is more than rounding. They would take {} workers: no one "
           "number fits.",
           speedups, kPaperWorkers,
           ofEach(4, [](const PaperStage& s) { return efficiency(s.speedup(), kPaperWorkers); }),
           ofEach(3, [](const PaperStage& s) { return s.efficiency; }),
           ofEach(0, [](const PaperStage& s) { return s.speedup() / s.efficiency; })),
       {"table-1", "table-2"},
       true},
      {fmt::format(
           "Table 3 does not follow from table 1. {} / {} is {:.1f} times the throughput, at speedups of {:.1f} to "
           "{:.1f}: by equation 4 the parallel program did {} times the operations. One figure stands for three "
           "stages.",
           kPaperParallelThroughput, kPaperSequentialThroughput, ratio, least->speedup(), most->speedup(),
           ofEach(1, [ratio](const PaperStage& s) { return ratio / s.speedup(); })),
       {"table-3", "table-1"},
       true},
      {"Table 1 is headed speedup and holds seconds; the delay that the text announces is in none of the tables. The "
       "speedup is cited as equation 4, and is equation 2.",
       {"table-1", "equation-2"},
       true},
      {fmt::format("m = {} is said nowhere else: of what, on which device.", kPaperWorkers),
       {"table-1", "table-2", "table-3"},
       true},
      {"Two machines: an Intel T2300 with a GTX 460 in section 3, an i7-2630QM with a GTX 460M in section 8.",
       {"table-1", "figure-16"},
       true},
      {"Section 5 cannot measure the time of the algorithm that works on shapes; the tables do not say which part of "
       "the work they time, nor how large the models are.",
       {"table-1", "figure-1", "figure-2"},
       true},
      {"The complexities of section 8 for morphing and for the hybrid differ by the factors 41 and 14 alone, digits "
       "the "
       "other way round, and factors do not belong into an O. What they are functions of, alpha, does not stand on "
       "their right side; r0 is not defined; and the sum that they are said to bound, T_ABC, is of a lower degree in a "
       "and b.",
       {"figure-1", "figure-2", "section-8"}},
      {"One letter for several things: P is throughput, the number pi and the set of position points, S is speedup and "
       "area.",
       {"equation-2", "equation-4", "equation-7", "equation-13", "equation-15", "table-3"}},
      {"Equation 3 holds efficiency below 1, and the text calls 1 the ideal case.", {"equation-3", "table-2"}, true},
      {"Area is said to grow with the logarithm of the mesh's density. A logarithm has no limit; the area of a smooth "
       "surface has one, which marching cubes approaches with the square of the cell's edge. Only roughness that every "
       "finer grid finds more of goes on growing.",
       {"figure-10", "figure-11"}},
      {"The best classification is said to be at LD = 10, and a large density to reduce the histogram to a single bar: "
       "angles along edges vanish with the edges' length, and with them what a histogram of angles tells apart.",
       {"figure-14", "figure-15", "equation-12"}},
      {"Figures 18, 22 and 28 are cited, and the last one is 16. Table 4 does not say what LOD of kind S is, nor N/O; "
       "it "
       "calls the system GK-M, which is SG+M elsewhere, denies it texture mapping, and no YES in it comes with a "
       "measurement.",
       {"figure-10", "figure-15", "figure-16", "table-4"}},
  };
}

}  // namespace sgm::cli

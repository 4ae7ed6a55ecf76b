#include "tools/paper/printed.h"

#include <fmt/core.h>

#include <algorithm>

namespace sgm::cli {
namespace {

/// Formats one value for each stage: "1.0, 2.0 and 3.0".
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
      {fmt::format("Table 2 does not follow from table 1. Its times give speedups of {}, and for {} workers "
                   "efficiencies of {}; the paper prints {}, which rounding does not explain. The printed values would "
                   "need {} workers: no one number fits.",
                   speedups, kPaperWorkers,
                   ofEach(4, [](const PaperStage& s) { return efficiency(s.speedup(), kPaperWorkers); }),
                   ofEach(3, [](const PaperStage& s) { return s.efficiency; }),
                   ofEach(0, [](const PaperStage& s) { return s.speedup() / s.efficiency; })),
       {"table-1", "table-2"},
       true},
      {fmt::format("Table 3 does not follow from table 1. {} / {} is {:.1f} times the throughput, at speedups of "
                   "{:.1f} to {:.1f}: by equation 4, the parallel program executed {} times the operations. One figure "
                   "stands for three stages.",
                   kPaperParallelThroughput, kPaperSequentialThroughput, ratio, least->speedup(), most->speedup(),
                   ofEach(1, [ratio](const PaperStage& s) { return ratio / s.speedup(); })),
       {"table-3", "table-1"},
       true},
      {"Table 1 has the heading speedup, but contains seconds; the delay that the text announces is in none of the "
       "tables. The speedup is cited as equation 4, but is equation 2.",
       {"table-1", "equation-2"},
       true},
      {fmt::format("m = {} is explained nowhere: neither what it counts nor on which device.", kPaperWorkers),
       {"table-1", "table-2", "table-3"},
       true},
      {"The paper names two machines: an Intel T2300 with a GTX 460 in section 3, an i7-2630QM with a GTX 460M in "
       "section 8.",
       {"table-1", "figure-16"},
       true},
      {"Section 5 says that the time of the algorithm on shapes cannot be measured; the tables do not say which part "
       "of the work they time, nor how large the models are.",
       {"table-1", "figure-1", "figure-2"},
       true},
      {"The complexities of section 8 for morphing and for the hybrid differ only by the factors 41 and 14, whose "
       "digits are swapped, and constant factors do not belong in an O. Their argument, alpha, does not occur on their "
       "right side; r0 is not defined; and the sum that they are said to bound, T_ABC, is of a lower degree in a and "
       "b.",
       {"figure-1", "figure-2", "section-8"}},
      {"Several letters have more than one meaning: P is throughput, the number pi and the set of position points, S "
       "is speedup and "
       "area.",
       {"equation-2", "equation-4", "equation-7", "equation-13", "equation-15", "table-3"}},
      {"Equation 3 requires an efficiency below 1, but the text calls 1 the ideal case.",
       {"equation-3", "table-2"},
       true},
      {"The area is said to grow with the logarithm of the mesh's density. A logarithm has no limit; the area of a "
       "smooth surface has one, which marching cubes approaches with the square of the cell's edge. Only roughness at "
       "ever smaller scales lets it grow further.",
       {"figure-10", "figure-11"}},
      {"The best classification is said to be at LD = 10, and yet a large density to reduce the histogram to a single "
       "bar: dihedral angles vanish with the length of the edges, and with them the differences between histograms of "
       "angles.",
       {"figure-14", "figure-15", "equation-12"}},
      {"Figures 18, 22 and 28 are cited, but the last one is 16. Table 4 explains neither LOD of kind S nor N/O; it "
       "calls the system GK-M, which is SG+M elsewhere, denies it texture mapping, and supports no YES by a "
       "measurement.",
       {"figure-10", "figure-15", "figure-16", "table-4"}},
  };
}

}  // namespace sgm::cli

#pragma once
// Figures printed in the paper: tables 1 to 3, their formulas, and the paper's contradictions. Nothing here is
// measured.

#include <array>
#include <string>
#include <vector>

namespace sgm::cli {

/// Equation 2 of the paper: the ratio of the sequential to the parallel time.
inline double speedup(double sequential, double parallel) { return sequential / parallel; }
/// Equation 3 of the paper. May exceed 1, because each further worker may add a cache of its own.
inline double efficiency(double speedup, double workers) { return speedup / workers; }
/// Equation 4 of the paper: results per second.
inline double throughput(double computed, double seconds) { return computed / seconds; }

/// One column of the tables: times in seconds from table 1, efficiency from table 2.
struct PaperStage {
  const char* name;
  double sequential, parallel;
  double efficiency;

  double speedup() const { return cli::speedup(sequential, parallel); }
};

inline constexpr std::array<PaperStage, 3> kPaperStages = {
    {{"cave", 0.81, 0.096, 0.028}, {"cloud", 0.62, 0.125, 0.015}, {"building", 0.54, 0.069, 0.027}}};
inline constexpr double kPaperWorkers = 255;
/// Table 3, the same two figures for all stages: Gflop/s.
inline constexpr double kPaperSequentialThroughput = 0.8, kPaperParallelThroughput = 20.61;

/// A contradiction in the paper, or an ambiguity.
struct Contradiction {
  std::string text;                 ///< explanation in one or two sentences
  std::vector<const char*> places;  ///< names of the affected places: "figure-10", "table-1", "equation-7", "section-8"
  bool of_tables = false;           ///< whether it concerns what `sgm bench paper` measures
};
/// All known contradictions in a fixed order. Their position, counted from 1, is their number in the report.
std::vector<Contradiction> contradictions();

}  // namespace sgm::cli

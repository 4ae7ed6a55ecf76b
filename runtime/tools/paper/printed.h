#pragma once
// Numbers printed in the paper (tables 1 to 3), formulas of the paper, and contradictions in the paper. Nothing in this
// file is measured.

#include <array>
#include <string>
#include <vector>

namespace sgm::cli {

/// Equation 2 of the paper: the ratio of the sequential to the parallel time.
inline double speedup(double sequential, double parallel) { return sequential / parallel; }
/// Equation 3 of the paper: speedup per worker. May exceed 1, because each additional worker may add a cache.
inline double efficiency(double speedup, double workers) { return speedup / workers; }
/// Equation 4 of the paper: number of computed results per second.
inline double throughput(double computed, double seconds) { return computed / seconds; }

/// One column (stage) of the paper's tables: times in seconds from table 1, efficiency from table 2.
struct PaperStage {
  const char* name;
  double sequential, parallel;
  double efficiency;

  double speedup() const { return cli::speedup(sequential, parallel); }
};

inline constexpr std::array<PaperStage, 3> kPaperStages = {
    {{"cave", 0.81, 0.096, 0.028}, {"cloud", 0.62, 0.125, 0.015}, {"building", 0.54, 0.069, 0.027}}};
inline constexpr double kPaperWorkers = 255;
/// Throughput in Gflop/s from table 3, which has the same two numbers for all stages.
inline constexpr double kPaperSequentialThroughput = 0.8, kPaperParallelThroughput = 20.61;

/// A contradiction or an ambiguity in the paper.
struct Contradiction {
  std::string text;                 ///< explanation in one or two sentences
  std::vector<const char*> places;  ///< names of the affected places: "figure-10", "table-1", "equation-7", "section-8"
  bool of_tables = false;  ///< whether the contradiction concerns tables 1 to 3, which `sgm bench paper` measures
};
/// All known contradictions in a fixed order. The index plus 1 is the number of a contradiction in the report.
std::vector<Contradiction> contradictions();

}  // namespace sgm::cli

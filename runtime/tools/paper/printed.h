#pragma once
// What the paper prints: tables 1 to 3, the formulas that they are said to follow from, and where it does not agree
// with itself. Nothing here measures.

#include <array>
#include <string>
#include <vector>

namespace sgm::cli {

/// Equation 2: how many times faster.
inline double speedup(double sequential, double parallel) { return sequential / parallel; }
/// Equation 3, not held below 1: a worker more may bring a cache of its own.
inline double efficiency(double speedup, double workers) { return speedup / workers; }
/// Equation 4: what was computed a second.
inline double throughput(double computed, double seconds) { return computed / seconds; }

/// One column of the tables. Seconds of table 1, efficiency of table 2.
struct PaperStage {
  const char* name;
  double sequential, parallel;
  double efficiency;

  double speedup() const { return cli::speedup(sequential, parallel); }
};

inline constexpr std::array<PaperStage, 3> kPaperStages = {
    {{"cave", 0.81, 0.096, 0.028}, {"cloud", 0.62, 0.125, 0.015}, {"building", 0.54, 0.069, 0.027}}};
inline constexpr double kPaperWorkers = 255;
/// Table 3, one figure for all stages: Gflop/s.
inline constexpr double kPaperSequentialThroughput = 0.8, kPaperParallelThroughput = 20.61;

/// Where the paper contradicts itself, or leaves open what it means.
struct Contradiction {
  std::string text;                 ///< a sentence or two
  std::vector<const char*> places;  ///< "figure-10", "table-1", "equation-7", "section-8"
  bool of_tables = false;           ///< of what `sgm bench paper` measures
};
/// All that were found, in one order for good: their numbers are their places in it, from 1 on.
std::vector<Contradiction> contradictions();

}  // namespace sgm::cli

#pragma once
// Printed figures of the paper: tables 1 to 3, their formulas, and its contradictions. Nothing here measures.

#include <array>
#include <string>
#include <vector>

namespace sgm::cli {

/// Equation 2: the ratio of times.
inline double speedup(double sequential, double parallel) { return sequential / parallel; }
/// Equation 3, which may exceed 1: each further worker may bring its own cache.
inline double efficiency(double speedup, double workers) { return speedup / workers; }
/// Equation 4: results per second.
inline double throughput(double computed, double seconds) { return computed / seconds; }

/// A column of the tables. Seconds of table 1, efficiency of table 2.
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

/// A contradiction in the paper, or an ambiguity.
struct Contradiction {
  std::string text;                 ///< a sentence or two
  std::vector<const char*> places;  ///< "figure-10", "table-1", "equation-7", "section-8"
  bool of_tables = false;           ///< concerns what `sgm bench paper` measures
};
/// All known ones, in a fixed order: their numbers are their places in it, from 1.
std::vector<Contradiction> contradictions();

}  // namespace sgm::cli

#pragma once
// Builds reference histograms from reference models.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/classify/base.h"
#include "tools/classify/corpus.h"

namespace sgm::masters {

/// The keys of the reference histograms: curvature at any density, and the paper's two modes at one and two cells per
/// metre, for which there are models of every class.
std::vector<measure::MasterKey> masterKeys();

/// The default of `sgm classify`: curvature by 65 bins, L = 1 m.
measure::MasterKey defaultKey();

/// Maximum of reference histograms for a grammar and key. Of models with other seeds, curvature classifies 95 %
/// correctly with 1 for each density, 97.8 % with 4 a grammar, 98.3 % with 6 and 98.7 % with 8. As many as 6 a grammar,
/// but from clusters of a whole class, classify fewer, since frequent kinds displace rare ones. The paper's modes have
/// fewer.
size_t mastersAGrammar(measure::HistogramMode mode);

/// A measured model.
struct Specimen {
  const Family* family = nullptr;
  uint64_t seed = 0;
  std::vector<std::vector<double>> shares;  ///< by masterKeys(); empty for another density than the family's
};

/// Called after every model; false cancels the work.
using BuildProgress = std::function<bool(uint64_t done, uint64_t total)>;

/// The first `models` models of each family for a seed. Different seeds share neither models nor parameters. Errors:
/// those of ModelMaker; cancelled.
Result<std::vector<Specimen>> specimensOf(std::span<const Family> families, uint64_t models, uint64_t seed,
                                          Backend& backend, JobSystem& jobs, const BuildProgress& progress = {});

/// The means of mastersAGrammar() clusters for each key and grammar. The limits also come from the specimens, without
/// noise: histograms built from one half are compared with the other half, and vice versa; a limit is kLimitSlack times
/// the 99th percentile of these distances. Contract: the specimens have models of every class for each key.
MasterSet mastersOf(std::span<const Specimen> specimens);
/// Fewer than 1 % of models with other seeds exceed 1.25 times that distance; noise classes catch nearer histograms.
inline constexpr double kLimitSlack = 2;

/// The set in the form of built_in_masters.inc; command: the command that made it.
std::string sourceOf(const MasterSet& set, const std::string& command);

}  // namespace sgm::masters

#pragma once
// Builds reference histograms from reference models.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/classify/base.h"
#include "tools/classify/corpus.h"

namespace sgm::masters {

/// The keys for which reference histograms are built: curvature, which does not depend on the density, and the paper's
/// two modes at one and two cells per metre. For these densities there are models of every class.
std::vector<measure::MasterKey> masterKeys();

/// The key that `sgm classify` uses by default: curvature with 65 bins, L = 1 m.
measure::MasterKey defaultKey();

/// Maximum number of reference histograms for one grammar and key. With the mode curvature, models with other seeds are
/// classified correctly in 95 % of the cases with 1 histogram for each density, 97.8 % with 4 for each grammar, 98.3 %
/// with 6 and 98.7 % with 8. If 6 a grammar are instead clustered over the whole class, fewer are classified correctly,
/// since frequent kinds displace rare ones. The paper's modes have fewer histograms.
size_t mastersAGrammar(measure::HistogramMode mode);

/// A model with its histograms.
struct Specimen {
  const Family* family = nullptr;
  uint64_t seed = 0;
  /// Histogram of each key of masterKeys(); empty if the key is for another density than the family's.
  std::vector<std::vector<double>> shares;
};

/// Called after every model with the number of finished models; returns false to cancel the work.
using BuildProgress = std::function<bool(uint64_t done, uint64_t total)>;

/// Measures the first `models` models of each family for a seed. Different seeds share neither models nor parameters.
/// Errors: those of ModelMaker; cancelled.
Result<std::vector<Specimen>> specimensOf(std::span<const Family> families, uint64_t models, uint64_t seed,
                                          Backend& backend, JobSystem& jobs, const BuildProgress& progress = {});

/// Builds the reference histograms: for each key and grammar, the means of mastersAGrammar() clusters. The limits also
/// come from the specimens, without noise: histograms built from one half of them are compared with the other half, and
/// vice versa; a limit is kLimitSlack times the 99th percentile of these distances. Contract: the specimens have models
/// of every class for each key.
MasterSet mastersOf(std::span<const Specimen> specimens);
/// Ratio of a limit to that percentile. Fewer than 1 % of models with other seeds exceed 1.25 times the percentile; the
/// noise classes reject histograms that lie nearer.
inline constexpr double kLimitSlack = 2;

/// The C++ source of the set in the form of built_in_masters.inc. command: the command that made the set, for its
/// comment.
std::string sourceOf(const MasterSet& set, const std::string& command);

}  // namespace sgm::masters

#pragma once
// Builds reference histograms from reference models.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/classify/base.h"
#include "tools/classify/corpus.h"

namespace sgm::masters {

/// The keys (histogram settings) for which reference histograms are built: mode curvature, which does not depend on the
/// mesh's density, and the paper's two modes at one and two cells per metre, because models of every class exist at
/// these densities.
std::vector<measure::MasterKey> masterKeys();

/// The key that `sgm classify` uses by default: curvature with 65 bins, L = 1 m.
measure::MasterKey defaultKey();

/// Maximum number of reference histograms for one grammar and key. More histograms classify better: in mode curvature,
/// the share of models with other seeds that are classified correctly is 95 % with 1 histogram for each density, 97.8 %
/// with 4 for each grammar, 98.3 % with 6, and 98.7 % with 8. Equally many histograms that are made by clustering all
/// models of a class at once classify worse, since frequent kinds of models displace rare ones. The paper's modes have
/// fewer histograms.
size_t mastersAGrammar(measure::HistogramMode mode);

/// A model with its histograms.
struct Specimen {
  const Family* family = nullptr;
  uint64_t seed = 0;
  /// One histogram for each key of masterKeys(); empty for a key whose density differs from the family's.
  std::vector<std::vector<double>> shares;
};

/// Called after every model with the number of finished models; returns false to cancel the work.
using BuildProgress = std::function<bool(uint64_t done, uint64_t total)>;

/// Computes the histograms of `models` models of each family, generated from a seed. Different seeds share neither
/// models nor parameters. Errors: those of ModelMaker; cancelled.
Result<std::vector<Specimen>> specimensOf(std::span<const Family> families, uint64_t models, uint64_t seed,
                                          Backend& backend, JobSystem& jobs, const BuildProgress& progress = {});

/// Builds the reference histograms: for each key and grammar, the means of mastersAGrammar() clusters of the specimens.
/// To find the limits, histograms built from one half of the specimens (without noise) are compared with the other
/// half, and vice versa; a limit is kLimitSlack times the 99th percentile of these distances. Contract: the specimens
/// have models of every class for each key.
MasterSet mastersOf(std::span<const Specimen> specimens);
/// Ratio of a limit to the 99th percentile of distances (see mastersOf()). At this ratio hardly any model with another
/// seed is rejected: fewer than 1 % exceed even 1.25 times the percentile. Meshes that belong to no class but are
/// within the limits are rejected by the class kNoise.
inline constexpr double kLimitSlack = 2;

/// The C++ source of the set in the form of built_in_masters.inc. command: the command that made the set, to be quoted
/// in a comment of the source.
std::string sourceOf(const MasterSet& set, const std::string& command);

}  // namespace sgm::masters

#pragma once
// Masters, made of a corpus of models.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/classify/base.h"
#include "tools/classify/corpus.h"

namespace sgm::masters {

/// What masters are made for: curvature at any density, and the paper's own two modes at one and two cells per metre,
/// for which there are models of every class.
std::vector<measure::MasterKey> masterKeys();

/// The default of `sgm classify`: curvature by 65 bins, L = 1 m.
measure::MasterKey defaultKey();

/// Masters of a grammar and key, at most. Of models of other seeds 1 for each density has 95 % right by curvature, 4 a
/// grammar have 97.8 %, 6 have 98.3 % and 8 have 98.7 %; as many as 6 a grammar, but by clusters of all of a class,
/// have less, since a rare kind takes masters from those that are many. The paper's modes have fewer.
size_t mastersAGrammar(measure::HistogramMode mode);

/// One model, measured.
struct Specimen {
  const Family* family = nullptr;
  uint64_t seed = 0;
  std::vector<std::vector<double>> shares;  ///< by masterKeys(); empty where the family has another density
};

/// Told after every model; false stops the work.
using BuildProgress = std::function<bool(uint64_t done, uint64_t total)>;

/// So many models of each family, the first ones of a seed. No two seeds have a model in common, nor its parameters.
/// Errors: those of ModelMaker; cancelled.
Result<std::vector<Specimen>> specimensOf(std::span<const Family> families, uint64_t models, uint64_t seed,
                                          Backend& backend, JobSystem& jobs, const BuildProgress& progress = {});

/// For each key and grammar the means of mastersAGrammar() clusters. Limits come from the specimens too, without noise:
/// masters of every second one are held against the others, and the other way round; the limits are kLimitSlack times
/// the distances that 99 of 100 keep within. Contract: the specimens have models of every class for each key.
MasterSet mastersOf(std::span<const Specimen> specimens);
/// Of models of other seeds less than one in a hundred is past 1.25 times; masters of noise find what is nearer.
inline constexpr double kLimitSlack = 2;

/// The set as built_in_masters.inc; command: how it was made.
std::string sourceOf(const MasterSet& set, const std::string& command);

}  // namespace sgm::masters

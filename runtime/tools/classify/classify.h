#pragma once
// Classifies a mesh by comparing its histogram with reference histograms of master objects (section 7.4 of the paper).

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "measure/histogram.h"

namespace sgm::measure {

/// Version of innerHistogram(), classError(), and of the way in which models are made (tools/classify/corpus.h).
/// Reference histograms of another version must be rebuilt.
inline constexpr uint32_t kMasterVersion = 2;

/// The parameters that two histograms must share to be comparable. All histograms use smooth, outward normals.
struct MasterKey {
  uint32_t bins = 33;  ///< R
  HistogramMode mode = HistogramMode::curvature;
  double length = 0;   ///< L of HistogramMode::curvature, metres; 0 in the other modes, which have none
  double density = 0;  ///< cells per metre; 0 for HistogramMode::curvature, which does not depend on the density
  uint32_t version = kMasterVersion;

  /// The histogram's settings for this key.
  HistogramSettings settings() const;
  friend bool operator==(const MasterKey&, const MasterKey&) = default;
};

/// Lists the differences, with a's value first: "33 bins, not 65; mode curvature, not printed". Empty if the keys are
/// equal.
std::string differenceOf(const MasterKey& a, const MasterKey& b);

/// The mean histogram of similar models. A class has any number of them: its models may differ widely (a hall's walls
/// and a cluster of dripstones), and their overall mean would resemble none of them.
struct Master {
  std::string class_name;
  std::string name;  ///< e.g. "walls": distinguishes the histograms of one key and class
  MasterKey key;
  uint32_t models = 0;         ///< number of models
  std::vector<double> shares;  ///< share of the samples in each bin
};

/// Distances beyond which a histogram of this key counts as similar to no reference histogram.
struct MasterLimits {
  MasterKey key;
  double mse = 0, emd = 0;  ///< classError() and earthMoversDistance() to the nearest master
};

/// The mean squared error (1 / R) sum (a - b)^2 over the R bins. Contract: equal numbers of bins.
double meanSquaredError(std::span<const double> a, std::span<const double> b);
/// The error by which classes are compared. In the paper's modes it is the mean squared error of the shares, as in the
/// paper; for HistogramMode::curvature, that of the square roots of the shares: most edges of any mesh are nearly flat,
/// and without the roots this uninformative bin would dominate the error. Contract: equal numbers of bins.
double classError(HistogramMode mode, std::span<const double> a, std::span<const double> b);
/// The earth mover's distance in units of the histogram's range: from 0 to 1 for histograms whose shares add up to 1.
/// Unlike the mean squared error, it grows with the number of bins between two single bars.
double earthMoversDistance(std::span<const double> a, std::span<const double> b);

struct ClassDistance {
  std::string class_name;
  std::string nearest;  ///< name of the class's reference histogram with the smallest error
  double mse = 0;       ///< classError() to that histogram
  /// earthMoversDistance() to the class's nearest histogram by this distance, which may be another one
  double emd = 0;
};

struct Classification {
  std::vector<ClassDistance> classes;  ///< nearest first, by mse
  std::string second_opinion;          ///< the nearest class by emd
  double margin = 0;                   ///< 1 - mse / mse of the next class: from 0, undecided, to 1
  std::string verdict;                 ///< the nearest class; kUnknown beyond a limit, and for noise
  std::string reason;                  ///< why it is unknown; otherwise empty
};

inline constexpr const char* kUnknown = "unknown";
/// The class of noise histograms. A mesh whose nearest reference histogram is noise is unknown: some histograms between
/// the classes belong to no class but are not far from one.
inline constexpr const char* kNoise = "noise";

/// Returns the nearest class, as in the paper, or kUnknown if no class is near or the histogram counts no edge. Error:
/// invalid_argument if the key of a reference histogram or of the limits differs from `key` (the message names the
/// difference), if there are no reference histograms, or if a histogram's number of bins does not fit its key.
Result<Classification> classify(std::span<const double> shares, const MasterKey& key, std::span<const Master> masters,
                                const MasterLimits& limits);

}  // namespace sgm::measure

#pragma once
// Classifies a mesh by comparing its histogram with reference histograms of master objects (section 7.4 of the paper).

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "measure/histogram.h"

namespace sgm::measure {

/// Version of innerHistogram(), classError(), and the making of models (tools/classify/corpus.h): reference histograms
/// of another version are rebuilt.
inline constexpr uint32_t kMasterVersion = 2;

/// The parameters on which comparable histograms agree. All use smooth, outward normals.
struct MasterKey {
  uint32_t bins = 33;  ///< R
  HistogramMode mode = HistogramMode::curvature;
  double length = 0;   ///< L of HistogramMode::curvature, metres; 0 in the other modes, which have none
  double density = 0;  ///< cells per metre; 0 for HistogramMode::curvature, which is independent of it
  uint32_t version = kMasterVersion;

  /// The histogram's settings for this key.
  HistogramSettings settings() const;
  friend bool operator==(const MasterKey&, const MasterKey&) = default;
};

/// The differences: "33 bins, not 65; mode curvature, not printed", a's value first. Empty if they are equal.
std::string differenceOf(const MasterKey& a, const MasterKey& b);

/// The mean histogram of similar models. A class has any number of them: its models may differ widely (a hall's walls
/// and a cluster of dripstones), and their overall mean would resemble none of them.
struct Master {
  std::string class_name;
  std::string name;  ///< e.g. "walls": distinguishes the histograms of one key and class
  MasterKey key;
  uint32_t models = 0;         ///< number of models
  std::vector<double> shares;  ///< of the bins
};

/// Distances of one key beyond which a histogram resembles no reference histogram.
struct MasterLimits {
  MasterKey key;
  double mse = 0, emd = 0;  ///< classError() and earthMoversDistance() to the nearest master
};

/// (1 / R) sum (a - b)^2. Contract: equal numbers of bins.
double meanSquaredError(std::span<const double> a, std::span<const double> b);
/// The error that separates classes: the mean squared error, as in the paper; for HistogramMode::curvature, of the
/// square roots of the shares. Most edges of any mesh are nearly flat, and without roots this uninformative bin would
/// dominate the error. Contract: equal numbers of bins.
double classError(HistogramMode mode, std::span<const double> a, std::span<const double> b);
/// The earth mover's distance with the range as unit: from 0 to 1 for histograms whose shares add up to 1. Unlike the
/// mean squared error, it grows with the number of bins between two single bars.
double earthMoversDistance(std::span<const double> a, std::span<const double> b);

struct ClassDistance {
  std::string class_name;
  std::string nearest;  ///< its reference histogram of the smallest error
  double mse = 0;       ///< classError()
  double emd = 0;       ///< to the nearest one by this distance, which may be another
};

struct Classification {
  std::vector<ClassDistance> classes;  ///< nearest first, by mse
  std::string second_opinion;          ///< the nearest class by emd
  double margin = 0;                   ///< 1 - mse / mse of the next class: from 0, undecided, to 1
  std::string verdict;                 ///< the nearest class; kUnknown beyond a limit, and for noise
  std::string reason;                  ///< why it is unknown; otherwise empty
};

inline constexpr const char* kUnknown = "unknown";
/// The class of noise histograms. A mesh nearest to one of them is unknown: between the classes there are histograms
/// that belong to none but are not far from any.
inline constexpr const char* kNoise = "noise";

/// The nearest class, as in the paper; kUnknown if no class is near, or the histogram counts no edge. Error:
/// invalid_argument if the key of a reference histogram or of the limits differs from `key` (with the difference), if
/// there are no reference histograms, or if a histogram's number of bins does not fit its key.
Result<Classification> classify(std::span<const double> shares, const MasterKey& key, std::span<const Master> masters,
                                const MasterLimits& limits);

}  // namespace sgm::measure

#pragma once
// Which class of models a mesh is of, by its histogram and those of master objects (section 7.4 of the paper).

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "measure/histogram.h"

namespace sgm::measure {

/// Of innerHistogram(), classError(), and of how models are made (tools/classify/corpus.h): masters of another version
/// are made anew.
inline constexpr uint32_t kMasterVersion = 2;

/// What two histograms must have in common to be compared. Of both the normals are smooth and point outward.
struct MasterKey {
  uint32_t bins = 33;  ///< R
  HistogramMode mode = HistogramMode::curvature;
  double length = 0;   ///< L of HistogramMode::curvature, metres; 0 in the other modes, which have none
  double density = 0;  ///< cells per metre; 0 for HistogramMode::curvature, which does not ask for any
  uint32_t version = kMasterVersion;

  /// The histogram's settings that it stands for.
  HistogramSettings settings() const;
  friend bool operator==(const MasterKey&, const MasterKey&) = default;
};

/// "33 bins, not 65; mode curvature, not printed": what `a` has and `b` has not. Empty where they are equal.
std::string differenceOf(const MasterKey& a, const MasterKey& b);

/// The mean of the histograms of like models. A class has any number of masters: those of one of them may lie far
/// apart (a hall's walls and a cluster of dripstones), and their mean is then like none of them.
struct Master {
  std::string class_name;
  std::string name;  ///< of what models it is the mean; no two masters of one key and class have the same
  MasterKey key;
  uint32_t models = 0;         ///< how many
  std::vector<double> shares;  ///< of the bins
};

/// Past which nothing is like a master: of one key.
struct MasterLimits {
  MasterKey key;
  double mse = 0, emd = 0;  ///< classError() and earthMoversDistance() to the nearest master
};

/// (1 / R) sum (a - b)^2. Contract: as many bins each.
double meanSquaredError(std::span<const double> a, std::span<const double> b);
/// What classes are told apart by: the mean squared error, as in the paper; for HistogramMode::curvature that of the
/// shares' square roots. Most edges of any mesh are nearly flat, and of the shares themselves this one bin makes almost
/// all of the error, although it says least of what a thing is. Contract: as many bins each.
double classError(HistogramMode mode, std::span<const double> a, std::span<const double> b);
/// What has to be moved how far to make one of the other, the whole range being 1: from 0 to 1 for histograms whose
/// shares add up to 1. Two single bars are the further apart the more bins lie between, which the mean squared error
/// does not see.
double earthMoversDistance(std::span<const double> a, std::span<const double> b);

struct ClassDistance {
  std::string class_name;
  std::string nearest;  ///< its master of the smallest error
  double mse = 0;       ///< classError()
  double emd = 0;       ///< to the nearest master by this distance, which may be another one
};

struct Classification {
  std::vector<ClassDistance> classes;  ///< nearest first, by mse
  std::string second_opinion;          ///< the nearest class by emd
  double margin = 0;                   ///< 1 - mse / mse of the next class: from 0, undecided, to 1
  std::string verdict;                 ///< the nearest class; kUnknown past a limit, and for noise
  std::string reason;                  ///< why it is unknown; else empty
};

inline constexpr const char* kUnknown = "unknown";
/// The class of masters that are like nothing in particular. What is nearest to one of them is unknown: between the
/// classes that a distance can tell apart there is room for histograms that are none of them, and not far from any.
inline constexpr const char* kNoise = "noise";

/// The nearest class, as in the paper; but where nothing is near, that is said. Of a histogram that counts no edge too.
/// Errors: invalid_argument where a master's or the limits' key is unlike `key`, which says what differs; where there
/// are no masters; where a histogram has not the bins that its key says.
Result<Classification> classify(std::span<const double> shares, const MasterKey& key, std::span<const Master> masters,
                                const MasterLimits& limits);

}  // namespace sgm::measure

#pragma once
// Classifies a mesh by comparing its histogram with reference histograms of master objects (section 7.4 of the paper).

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "measure/histogram.h"

namespace sgm::measure {

/// Version of the reference histograms: increased whenever innerHistogram(), classError(), or the generation of models
/// (tools/classify/corpus.h) changes. Reference histograms of another version must be rebuilt.
inline constexpr uint32_t kMasterVersion = 2;

/// The parameters that two histograms must share to be comparable. All histograms use smooth, outward normals.
struct MasterKey {
  uint32_t bins = 33;  ///< R
  HistogramMode mode = HistogramMode::curvature;
  double length = 0;   ///< length L of HistogramMode::curvature, metres; 0 in the other modes
  double density = 0;  ///< cells per metre; 0 for HistogramMode::curvature, which does not depend on the density
  uint32_t version = kMasterVersion;

  /// The settings with which a histogram of this key is computed.
  HistogramSettings settings() const;
  friend bool operator==(const MasterKey&, const MasterKey&) = default;
};

/// Lists the differences, with a's value first: "33 bins, not 65; mode curvature, not printed" ("printed" is the name
/// of a mode). Empty if the keys are equal.
std::string differenceOf(const MasterKey& a, const MasterKey& b);

/// A reference histogram: the mean of the histograms of similar models. A class has any number of reference histograms:
/// its models may differ widely (a hall's walls and a cluster of dripstones), and their overall mean would resemble
/// none of them.
struct Master {
  std::string class_name;
  std::string name;  ///< distinguishes the reference histograms of one class and key, e.g. "walls"
  MasterKey key;
  uint32_t models = 0;         ///< number of models whose histograms were averaged
  std::vector<double> shares;  ///< share of the counted edges in each bin
};

/// Distances beyond which a histogram of this key counts as similar to no reference histogram.
struct MasterLimits {
  MasterKey key;
  /// Limits of classError() (mse) and earthMoversDistance() (emd) to the nearest reference histogram.
  double mse = 0, emd = 0;
};

/// The mean squared error (1 / R) sum (a - b)^2 over the R bins. Contract: equal numbers of bins.
double meanSquaredError(std::span<const double> a, std::span<const double> b);
/// The error by which classes are compared. In the paper's modes it is the mean squared error of the shares, as in the
/// paper. For HistogramMode::curvature it is the mean squared error of the square roots of the shares: most edges of
/// any mesh are nearly flat, and without the roots the bin of these edges, which tells nothing, would dominate the
/// error. Contract: equal numbers of bins.
double classError(HistogramMode mode, std::span<const double> a, std::span<const double> b);
/// The earth mover's distance in units of the histogram's range: from 0 to 1 for histograms whose shares add up to 1.
/// Unlike the mean squared error, it grows with the distance over which shares must be moved between bins.
double earthMoversDistance(std::span<const double> a, std::span<const double> b);

struct ClassDistance {
  std::string class_name;
  std::string nearest;  ///< name of the class's reference histogram with the smallest error
  double mse = 0;       ///< classError() to the reference histogram `nearest`
  /// smallest earthMoversDistance() to a reference histogram of the class, not necessarily to `nearest`
  double emd = 0;
};

struct Classification {
  std::vector<ClassDistance> classes;  ///< one entry for each class, in ascending order of mse
  std::string second_opinion;          ///< class with the smallest emd (earth mover's distance)
  double margin = 0;                   ///< 1 - smallest mse / second smallest mse: from 0 (undecided) to 1
  std::string verdict;                 ///< the nearest class; kUnknown if it is kNoise or farther than a limit
  std::string reason;                  ///< why the verdict is kUnknown; otherwise empty
};

inline constexpr const char* kUnknown = "unknown";
/// The class of noise meshes. A mesh that is nearest to this class counts as unknown, so that meshes of no class are
/// rejected even if they are within the limits of some class.
inline constexpr const char* kNoise = "noise";

/// Returns the nearest class, as in the paper, or kUnknown if no class is near or the histogram counts no edge. Error:
/// invalid_argument if the key of a reference histogram or of the limits differs from `key` (the message names the
/// difference), if there are no reference histograms, or if a histogram's number of bins does not fit its key.
Result<Classification> classify(std::span<const double> shares, const MasterKey& key, std::span<const Master> masters,
                                const MasterLimits& limits);

}  // namespace sgm::measure

#include "tools/classify/classify.h"

#include <algorithm>
#include <cmath>

#include "base/plain_text.h"

namespace sgm::measure {
namespace {

std::string number(double value) { return generalText(value); }

std::string densityOf(const MasterKey& key) {
  return key.density > 0 ? number(key.density) + " cells per metre" : "any density";
}

Result<void> fits(const Master& master, const MasterKey& key) {
  if (const std::string difference = differenceOf(key, master.key); !difference.empty()) {
    return Error{Code::invalid_argument, "the histogram cannot be compared with the reference histogram " +
                                             master.name + ": it has " + difference};
  }
  if (master.shares.size() != binsOf(key.settings())) {
    return Error{Code::invalid_argument,
                 "the reference histogram " + master.name + " does not have as many bins as its key says"};
  }
  return {};
}

void nearer(ClassDistance& of, const Master& master, std::span<const double> shares) {
  const double mse = classError(master.key.mode, shares, master.shares);
  if (mse < of.mse) {
    of.mse = mse;
    of.nearest = master.name;
  }
  of.emd = std::min(of.emd, earthMoversDistance(shares, master.shares));
}

std::string whyUnknown(const ClassDistance& nearest, double least_emd, const MasterLimits& limits) {
  if (nearest.class_name == kNoise) return "it is most like " + nearest.nearest;
  if (nearest.mse > limits.mse) {
    return "the mean squared error to every reference histogram is more than " + number(limits.mse);
  }
  if (least_emd > limits.emd)
    return "the earth mover's distance to every reference histogram is more than " + number(limits.emd);
  return {};
}

}  // namespace

HistogramSettings MasterKey::settings() const {
  HistogramSettings settings;
  settings.mode = mode;
  settings.bins = bins;
  if (mode == HistogramMode::curvature) settings.length = length;
  return settings;
}

std::string differenceOf(const MasterKey& a, const MasterKey& b) {
  std::string text;
  const auto say = [&](bool differs, const std::string& what) {
    if (differs) text += (text.empty() ? "" : "; ") + what;
  };
  const auto of = [](HistogramMode mode) { return std::string(nameOf(mode)); };
  say(a.bins != b.bins, std::to_string(a.bins) + " bins, not " + std::to_string(b.bins));
  say(a.mode != b.mode, "mode " + of(a.mode) + ", not " + of(b.mode));
  say(a.mode == b.mode && a.length != b.length, "curvature length " + number(a.length) + ", not " + number(b.length));
  say(a.mode == b.mode && a.density != b.density, densityOf(a) + ", not " + densityOf(b));
  say(a.version != b.version, "version " + std::to_string(a.version) + ", not " + std::to_string(b.version));
  return text;
}

double meanSquaredError(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return a.empty() ? 0 : sum / static_cast<double>(a.size());
}

double classError(HistogramMode mode, std::span<const double> a, std::span<const double> b) {
  if (mode != HistogramMode::curvature) return meanSquaredError(a, b);
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double off = std::sqrt(a[i]) - std::sqrt(b[i]);
    sum += off * off;
  }
  return a.empty() ? 0 : sum / static_cast<double>(a.size());
}

double earthMoversDistance(std::span<const double> a, std::span<const double> b) {
  double carried = 0, sum = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    carried += a[i] - b[i];
    sum += std::fabs(carried);
  }
  return a.size() > 1 ? sum / static_cast<double>(a.size() - 1) : 0;
}

Result<Classification> classify(std::span<const double> shares, const MasterKey& key, std::span<const Master> masters,
                                const MasterLimits& limits) {
  if (masters.empty()) {
    return Error{Code::invalid_argument,
                 "there are no reference histograms to compare with: make some with sgm masters build"};
  }
  if (shares.size() != binsOf(key.settings())) {
    return Error{Code::invalid_argument, "the histogram does not have as many bins as its key says"};
  }
  if (const std::string difference = differenceOf(key, limits.key); !difference.empty()) {
    return Error{Code::invalid_argument, "the limits are for another key than the histogram's: it has " + difference};
  }
  Classification result;
  for (const Master& master : masters) {
    if (const Result<void> ok = fits(master, key); !ok) return ok.error();
    auto of = std::ranges::find(result.classes, master.class_name, &ClassDistance::class_name);
    if (of == result.classes.end()) of = result.classes.insert(of, {master.class_name, "", HUGE_VAL, HUGE_VAL});
    nearer(*of, master, shares);
  }
  std::ranges::stable_sort(result.classes, {}, &ClassDistance::mse);
  const ClassDistance& nearest = result.classes.front();
  const ClassDistance& by_emd = *std::ranges::min_element(result.classes, {}, &ClassDistance::emd);
  result.second_opinion = by_emd.class_name;
  if (result.classes.size() > 1 && result.classes[1].mse > 0) result.margin = 1 - nearest.mse / result.classes[1].mse;
  const bool edges = std::ranges::any_of(shares, [](double share) { return share > 0; });
  result.reason = edges ? whyUnknown(nearest, by_emd.emd, limits) : "it has no edge that could be measured";
  result.verdict = result.reason.empty() ? nearest.class_name : kUnknown;
  return result;
}

}  // namespace sgm::measure

#include "tools/classify/build.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>

#include "base/hash.h"
#include "base/plain_text.h"

namespace sgm::masters {
namespace {

using measure::HistogramMode;
using measure::Master;
using measure::MasterKey;
using measure::MasterLimits;
using Shares = std::vector<double>;

constexpr double kMillion = 1e6;

/// The histogram of one model, and the model's family.
struct Member {
  const Family* family;
  const Shares* shares;
};

Shares meanOf(std::span<const Member> members) {
  Shares mean(members.front().shares->size());
  for (const Member& member : members) {
    for (size_t i = 0; i < mean.size(); ++i) mean[i] += (*member.shares)[i];
  }
  for (double& share : mean) share /= static_cast<double>(members.size());
  return mean;
}

size_t nearestOf(HistogramMode mode, const Shares& shares, std::span<const Shares> centres) {
  size_t nearest = 0;
  double least = HUGE_VAL;
  for (size_t i = 0; i < centres.size(); ++i) {
    const double mse = measure::classError(mode, shares, centres[i]);
    if (mse < least) {
      least = mse;
      nearest = i;
    }
  }
  return nearest;
}

/// Divides histograms into clusters by Lloyd's algorithm (k-means). It starts with members that lie far apart, so that
/// the result is deterministic.
std::vector<std::vector<Member>> clustersOf(HistogramMode mode, std::span<const Member> members) {
  std::vector<Shares> centres{*members.front().shares};
  while (centres.size() < std::min(mastersAGrammar(mode), members.size())) {
    const auto distance = [&](const Member& member) {
      return measure::classError(mode, *member.shares, centres[nearestOf(mode, *member.shares, centres)]);
    };
    centres.push_back(*std::ranges::max_element(members, {}, distance)->shares);
  }
  std::vector<std::vector<Member>> clusters;
  for (int round = 0; round < 20; ++round) {
    clusters.assign(centres.size(), {});
    for (const Member& member : members) clusters[nearestOf(mode, *member.shares, centres)].push_back(member);
    std::erase_if(clusters, [](const std::vector<Member>& cluster) { return cluster.empty(); });
    centres.clear();
    for (const std::vector<Member>& cluster : clusters) centres.push_back(meanOf(cluster));
  }
  return clusters;
}

/// Rounds shares to millionths, such that their sum is still one. So sourceOf() can write the exact values.
Shares rounded(const Shares& shares) {
  std::vector<double> parts(shares.size());
  std::vector<size_t> order(shares.size());
  std::iota(order.begin(), order.end(), size_t{0});
  double left = kMillion;
  for (size_t i = 0; i < shares.size(); ++i) left -= parts[i] = std::floor(shares[i] * kMillion);
  std::ranges::stable_sort(order, std::greater(), [&](size_t i) { return shares[i] * kMillion - parts[i]; });
  for (size_t i = 0; i < order.size() && left > 0; ++i, --left) ++parts[order[i]];
  for (double& part : parts) part /= kMillion;
  return parts;
}

std::vector<Master> mastersFor(const MasterKey& key, std::span<const Member> members) {
  std::vector<Master> masters;
  std::map<std::string_view, size_t> numbers;
  std::map<std::pair<std::string_view, std::string_view>, std::vector<Member>> grammars;
  for (const Member& member : members) grammars[{member.family->class_name, member.family->file}].push_back(member);
  for (const auto& [names, all] : grammars) {
    const std::string class_name(names.first), file(names.second);
    for (const std::vector<Member>& cluster : clustersOf(key.mode, all)) {
      masters.push_back({class_name, class_name + " " + std::to_string(++numbers[names.first]) + ", most like " + file,
                         key, static_cast<uint32_t>(cluster.size()), rounded(meanOf(cluster))});
    }
  }
  return masters;
}

/// Rounds a value to three significant digits, so that sourceOf() writes it exactly.
double toThreeDigits(double value) {
  const std::string text = generalText(value, 3);
  double out = value;
  std::from_chars(text.data(), text.data() + text.size(), out);
  return out;
}

double limitOf(std::vector<double>& distances) {
  std::ranges::sort(distances);
  return toThreeDigits(kLimitSlack * distances[std::min(distances.size() - 1, distances.size() * 99 / 100)]);
}

MasterLimits limitsFor(const MasterKey& key, std::span<const Member> members) {
  std::vector<double> mse, emd;
  for (const size_t half : {size_t{0}, size_t{1}}) {
    std::vector<Member> built, held_out;
    for (size_t i = 0; i < members.size(); ++i) (i % 2 == half ? built : held_out).push_back(members[i]);
    if (built.empty()) continue;
    const std::vector<Master> masters = mastersFor(key, built);
    for (const Member& member : held_out) {
      double least_mse = HUGE_VAL, least_emd = HUGE_VAL;
      for (const Master& master : masters) {
        least_mse = std::min(least_mse, measure::classError(key.mode, *member.shares, master.shares));
        least_emd = std::min(least_emd, measure::earthMoversDistance(*member.shares, master.shares));
      }
      mse.push_back(least_mse);
      emd.push_back(least_emd);
    }
  }
  if (mse.empty()) return {key, 0, 0};
  return {key, limitOf(mse), limitOf(emd)};
}

bool isOf(const MasterKey& key, const Family& family) { return key.density == 0 || key.density == 1 / family.cell; }

}  // namespace

MasterKey defaultKey() { return {65, HistogramMode::curvature, 1, 0, measure::kMasterVersion}; }

size_t mastersAGrammar(HistogramMode mode) { return mode == HistogramMode::curvature ? 6 : 2; }

std::vector<MasterKey> masterKeys() {
  std::vector<MasterKey> keys{defaultKey()};
  for (const HistogramMode mode : {HistogramMode::printed, HistogramMode::corrected}) {
    for (const double density : {1, 2}) keys.push_back({33, mode, 0, density, measure::kMasterVersion});
  }
  return keys;
}

Result<std::vector<Specimen>> specimensOf(std::span<const Family> families, uint64_t models, uint64_t seed,
                                          Backend& backend, JobSystem& jobs, const BuildProgress& progress) {
  const std::vector<MasterKey> keys = masterKeys();
  std::vector<Specimen> specimens;
  for (const Family& family : families) {
    const Result<ModelMaker> maker = ModelMaker::create(family);
    if (!maker) return maker.error();
    for (uint64_t i = 0; i < models; ++i) {
      Specimen specimen{&family, hashCombine(seed, i), {}};
      const Result<ModelMesh> model = maker->make(specimen.seed, backend, jobs);
      if (!model) return model.error();
      for (const MasterKey& key : keys) {
        Shares& shares = specimen.shares.emplace_back();
        if (!isOf(key, family)) continue;
        Result<measure::Histogram> histogram =
            measure::innerHistogram({model->points, model->triangles}, key.settings(), jobs);
        if (!histogram) return histogram.error();
        shares = std::move(histogram->shares);
      }
      specimens.push_back(std::move(specimen));
      if (progress && !progress(specimens.size(), families.size() * models)) {
        return Error{Code::cancelled, "the building of reference histograms was cancelled"};
      }
    }
  }
  return specimens;
}

MasterSet mastersOf(std::span<const Specimen> specimens) {
  MasterSet set;
  const std::vector<MasterKey> keys = masterKeys();
  for (size_t k = 0; k < keys.size(); ++k) {
    std::vector<Member> members;
    for (const Specimen& specimen : specimens) {
      if (!specimen.shares[k].empty()) members.push_back({specimen.family, &specimen.shares[k]});
    }
    if (members.empty()) continue;
    std::vector<Member> known;
    std::ranges::copy_if(members, std::back_inserter(known),
                         [](const Member& member) { return member.family->class_name != measure::kNoise; });
    set.limits.push_back(limitsFor(keys[k], known));
    const std::vector<Master> masters = mastersFor(keys[k], members);
    set.masters.insert(set.masters.end(), masters.begin(), masters.end());
  }
  return set;
}

std::string sourceOf(const MasterSet& set, const std::string& command) {
  std::string text = "// Written by `" + command + "`, and by nothing else.\n";
  text += "\n// Bins, mode, curvature length, density, version, limits of the two distances, masters.\n";
  text += "constexpr BuiltInKey kKeys[] = {\n";
  for (const MasterLimits& l : set.limits) {
    const std::string mode(measure::nameOf(l.key.mode));
    text += "    {" + std::to_string(l.key.bins) + ", HistogramMode::" + mode + ", " + generalText(l.key.length) +
            ", " + generalText(l.key.density) + ", " + std::to_string(l.key.version) + ", " + generalText(l.mse) +
            ", " + generalText(l.emd) + ", " + std::to_string(set.of(l.key).size()) + "},\n";
  }
  text += "};\n\n// In the order of the keys; of how many models; shares in millionths.\n";
  text += "constexpr BuiltInMaster kMasters[] = {\n";
  for (const MasterLimits& l : set.limits) {
    for (const Master& master : set.of(l.key)) {
      text +=
          "    {\"" + master.class_name + "\", \"" + master.name + "\", " + std::to_string(master.models) + ",\n     {";
      size_t column = 6;
      for (size_t i = 0; i < master.shares.size(); ++i) {
        const std::string share =
            std::to_string(std::llround(master.shares[i] * kMillion)) + (i + 1 < master.shares.size() ? "," : "}},\n");
        if (column + share.size() + 1 > 118) {
          text += "\n     ";
          column = 5;
        }
        const bool begins = column <= 6;
        text += (begins ? "" : " ") + share;
        column += share.size() + (begins ? 0 : 1);
      }
    }
  }
  return text + "};\n";
}

}  // namespace sgm::masters

// Tests distances between histograms, and the resulting verdicts.

#include "tools/classify/classify.h"

#include <cmath>

#include "../catch.h"
#include "../rounds.h"
#include "shapes.h"

namespace sgm::measure {
namespace {

std::vector<double> randomShares(std::mt19937& random, size_t bins) {
  std::vector<double> shares(bins);
  double sum = 0;
  for (double& share : shares) sum += share = between(random, 0, 1);
  for (double& share : shares) share /= sum;
  return shares;
}

std::vector<double> bar(size_t bins, size_t at) {
  std::vector<double> shares(bins);
  shares[at] = 1;
  return shares;
}

MasterKey smallKey() { return {5, HistogramMode::curvature, 1, 0, kMasterVersion}; }

Master masterOf(const std::string& class_name, std::vector<double> shares) {
  return {class_name, class_name + " 1", smallKey(), 1, std::move(shares)};
}

const std::vector<Master> kThree{masterOf("cave", {0.8, 0.2, 0, 0, 0}), masterOf("building", {0, 0.1, 0.8, 0.1, 0}),
                                 masterOf("cloud", {0, 0, 0, 0.2, 0.8})};
const MasterLimits kWide{smallKey(), 1, 1};

}  // namespace

TEST_CASE("both distances are metrics' kin: nothing to itself, the same both ways", "[classify]") {
  for (unsigned seed = 0; seed < rounds(50); ++seed) {
    std::mt19937 random(seed);
    const size_t bins = 2 + random() % 90;
    const std::vector<double> a = randomShares(random, bins), b = randomShares(random, bins),
                              c = randomShares(random, bins);
    CAPTURE(seed, bins);
    CHECK(meanSquaredError(a, a) == 0);
    CHECK(earthMoversDistance(a, a) == 0);
    CHECK(meanSquaredError(a, b) == Approx(meanSquaredError(b, a)));
    CHECK(earthMoversDistance(a, b) == Approx(earthMoversDistance(b, a)));
    CHECK(meanSquaredError(a, b) > 0);
    CHECK(earthMoversDistance(a, b) > 0);
    CHECK(earthMoversDistance(a, b) <= 1);
    CHECK(earthMoversDistance(a, c) <= earthMoversDistance(a, b) + earthMoversDistance(b, c) + 1e-12);
    CHECK(std::sqrt(meanSquaredError(a, c)) <=
          std::sqrt(meanSquaredError(a, b)) + std::sqrt(meanSquaredError(b, c)) + 1e-12);
  }
}

TEST_CASE("single bars have one error however far apart, and the earth mover sees how far", "[classify]") {
  for (size_t at = 1; at < 33; ++at) {
    CHECK(meanSquaredError(bar(33, 0), bar(33, at)) == Approx(2.0 / 33));
    CHECK(earthMoversDistance(bar(33, 0), bar(33, at)) == Approx(static_cast<double>(at) / 32));
  }
  CHECK(meanSquaredError({}, {}) == 0);
  CHECK(earthMoversDistance(bar(1, 0), bar(1, 0)) == 0);
}

TEST_CASE("of curvature the error is that of the shares' roots, of the paper's modes that of the shares",
          "[classify]") {
  // Both histograms differ from `flat` by a share of 0.1: in `convex`, this share is in one other bin; in `both`, it is
  // divided between two bins.
  const std::vector<double> flat{0, 1, 0}, convex{0, 0.9, 0.1}, both{0.05, 0.9, 0.05};
  CHECK(classError(HistogramMode::printed, flat, convex) == meanSquaredError(flat, convex));
  CHECK(classError(HistogramMode::corrected, flat, both) == meanSquaredError(flat, both));
  const double off = 1 - std::sqrt(0.9);
  CHECK(classError(HistogramMode::curvature, flat, convex) == Approx((off * off + 0.1) / 3));
  CHECK(classError(HistogramMode::curvature, flat, both) == Approx((off * off + 2 * 0.05) / 3));
  // In curvature mode, a small share of edges in another bin counts more than a larger change of the share of flat
  // edges.
  const std::vector<double> flatter{0, 0.99, 0.01}, concave{0.01, 0.99, 0}, less{0, 0.95, 0.05};
  CHECK(classError(HistogramMode::curvature, flatter, concave) > classError(HistogramMode::curvature, flatter, less));
  CHECK(meanSquaredError(flatter, concave) < meanSquaredError(flatter, less));
  CHECK(classError(HistogramMode::curvature, {}, {}) == 0);
}

TEST_CASE("the nearest master gives the class, and the others stand behind it", "[classify]") {
  for (const Master& master : kThree) {
    const auto said = classify(master.shares, smallKey(), kThree, kWide);
    REQUIRE(said);
    CHECK(said->verdict == master.class_name);
    CHECK(said->second_opinion == master.class_name);
    CHECK(said->margin == 1);
    CHECK(said->reason.empty());
    REQUIRE(said->classes.size() == 3);
    CHECK(said->classes[0].mse == 0);
    CHECK(said->classes[0].nearest == master.name);
    CHECK(said->classes[1].mse <= said->classes[2].mse);
  }
}

TEST_CASE("a class may have masters that are unlike each other", "[classify]") {
  std::vector<Master> masters = kThree;
  masters.push_back(masterOf("cave", {0, 0, 0, 1, 0}));
  masters.back().name = "cave 2";
  const auto said = classify(std::vector<double>{0, 0, 0, 0.9, 0.1}, smallKey(), masters, kWide);
  REQUIRE(said);
  CHECK(said->verdict == "cave");
  CHECK(said->classes.size() == 3);
  CHECK(said->classes[0].nearest == "cave 2");
}

TEST_CASE("between two classes there is no margin", "[classify]") {
  const std::vector<Master> two{masterOf("cave", bar(5, 0)), masterOf("cloud", bar(5, 4))};
  const auto said = classify(std::vector<double>{0.5, 0, 0, 0, 0.5}, smallKey(), two, kWide);
  REQUIRE(said);
  CHECK(said->margin == 0);
}

TEST_CASE("past either limit, and without an edge, it is unknown", "[classify]") {
  const std::vector<double> off{0.7, 0.3, 0, 0, 0};
  const double mse = classError(HistogramMode::curvature, off, kThree[0].shares),
               emd = earthMoversDistance(off, kThree[0].shares);
  const auto said = [&](double max_mse, double max_emd, const std::vector<double>& shares) {
    return *classify(shares, smallKey(), kThree, {smallKey(), max_mse, max_emd});
  };
  CHECK(said(mse, emd, off).verdict == "cave");
  CHECK(said(mse * 0.99, emd, off).verdict == kUnknown);
  CHECK(said(mse * 0.99, emd, off).reason.find("mean squared error") != std::string::npos);
  CHECK(said(mse, emd * 0.99, off).verdict == kUnknown);
  CHECK(said(mse, emd * 0.99, off).reason.find("earth mover") != std::string::npos);
  CHECK(said(mse, emd * 0.99, off).classes[0].class_name == "cave");
  CHECK(said(1, 1, std::vector<double>(5)).verdict == kUnknown);
}

TEST_CASE("what is most like noise is unknown", "[classify]") {
  std::vector<Master> masters = kThree;
  masters.push_back(masterOf(kNoise, {0.2, 0.2, 0.2, 0.2, 0.2}));
  const auto said = classify(masters.back().shares, smallKey(), masters, kWide);
  REQUIRE(said);
  CHECK(said->verdict == kUnknown);
  CHECK(said->reason == "it is most like noise 1");
  CHECK(said->classes[0].class_name == kNoise);
  CHECK(classify(kThree[0].shares, smallKey(), masters, kWide)->verdict == "cave");
}

TEST_CASE("unlike histograms are not compared, and what differs is said", "[classify]") {
  const MasterKey key = smallKey();
  const auto other = [&](auto change) {
    MasterKey changed = key;
    change(changed);
    return changed;
  };
  const std::vector<std::pair<MasterKey, std::string>> cases{
      {other([](MasterKey& k) { k.bins = 7; }), "7 bins, not 5"},
      {other([](MasterKey& k) { k.mode = HistogramMode::corrected; }), "mode corrected, not curvature"},
      {other([](MasterKey& k) { k.length = 2; }), "curvature length 2, not 1"},
      {other([](MasterKey& k) { k.density = 4; }), "4 cells per metre, not any density"},
      {other([](MasterKey& k) { k.version = 9; }), "version 9, not " + std::to_string(kMasterVersion)}};
  for (const auto& [wrong, what] : cases) {
    CAPTURE(what);
    CHECK(differenceOf(wrong, key) == what);
    const std::vector<double> shares(binsOf(wrong.settings()));
    const auto said = classify(shares, wrong, kThree, {wrong, 1, 1});
    REQUIRE_FALSE(said);
    CHECK(said.error().code == Code::invalid_argument);
    CHECK(said.error().message.find(what) != std::string::npos);
    CHECK_FALSE(classify(kThree[0].shares, key, kThree, {wrong, 1, 1}));
  }
  CHECK(differenceOf(key, key).empty());
  CHECK_FALSE(classify(kThree[0].shares, key, {}, kWide));
  CHECK_FALSE(classify(bar(4, 0), key, kThree, kWide));
  std::vector<Master> short_one = kThree;
  short_one[1].shares.pop_back();
  CHECK_FALSE(classify(kThree[0].shares, key, short_one, kWide));
}

TEST_CASE("as many bins as the mode has", "[classify]") {
  const auto jobs = std::move(*makeThreadPool(1));
  std::mt19937 random(1);
  const Mesh mesh = randomSurface(random, 7);
  for (uint32_t bins = 1; bins < 100; ++bins) {
    for (const HistogramMode mode : {HistogramMode::printed, HistogramMode::corrected, HistogramMode::curvature}) {
      HistogramSettings settings;
      settings.mode = mode;
      settings.bins = bins;
      CHECK(innerHistogram(mesh, settings, *jobs)->shares.size() == binsOf(settings));
    }
  }
}

TEST_CASE("edges that touch a border do not count", "[classify]") {
  const auto jobs = std::move(*makeThreadPool(1));
  // Four by four quadrangles: of the 5 by 5 points, only the inner 3 by 3 are not on the border.
  Mesh mesh;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j) mesh.points.push_back({i * 1.0, j * 1.0, i == 0 ? 5.0 : 0.0});
  for (uint32_t i = 0; i < 4; ++i) {
    for (uint32_t j = 0; j < 4; ++j) {
      const uint32_t a = i * 5 + j, b = a + 5;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  const auto h = innerHistogram(mesh, {}, *jobs);
  REQUIRE(h);
  // Each of the 16 edges between inner points counts in both of its triangles.
  CHECK(h->edges == 2 * (6 + 6 + 4));
  CHECK(h->left_out == 3 * mesh.triangles.size() - h->edges);
  const auto none = innerHistogram(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}, *jobs);
  REQUIRE(none);
  CHECK(none->edges == 0);
}

}  // namespace sgm::measure

// Tests the histogram of dihedral angles: against the paper's figures, against its definition, and that flat surfaces
// count as flat.

#include "measure/histogram.h"

#include <memory>
#include <numeric>

#include "../catch.h"
#include "../rounds.h"
#include "shapes.h"

namespace sgm::measure {
namespace {

Histogram of(const Mesh& mesh, const HistogramSettings& settings, unsigned threads = 2) {
  const auto jobs = std::move(*makeThreadPool(threads));
  const Edges edges(mesh);
  return *histogramOf(mesh, smoothNormals(mesh), &edges, settings, *jobs);
}

double sumOf(const Histogram& h) { return std::accumulate(h.shares.begin(), h.shares.end(), 0.0); }

/// A square of n by n quadrangles in the plane z = 0.
Mesh flatGrid(uint32_t n) {
  Mesh mesh;
  for (uint32_t i = 0; i <= n; ++i)
    for (uint32_t j = 0; j <= n; ++j) mesh.points.push_back({static_cast<double>(i), static_cast<double>(j), 0});
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      const uint32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

}  // namespace

TEST_CASE("shares add up to one, in every mode and for any number of bins", "[histogram]") {
  for (unsigned seed = 0; seed < rounds(30); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const Mesh mesh = randomSurface(random, 7);
    for (const HistogramMode mode : {HistogramMode::printed, HistogramMode::corrected, HistogramMode::curvature}) {
      HistogramSettings settings{mode, 1 + static_cast<uint32_t>(random() % 100), between(random, 0.1, 10),
                                 random() % 2 == 0};
      const Histogram h = of(mesh, settings);
      CAPTURE(nameOf(mode), settings.bins);
      CHECK(h.edges + h.left_out == (settings.unique_edges ? Edges(mesh).count() : 3 * mesh.triangles.size()));
      CHECK(sumOf(h) == Approx(h.edges > 0 ? 1 : 0).margin(1e-12));
      CHECK(h.flat + h.convex + h.concave == Approx(h.edges > 0 ? 1 : 0).margin(1e-12));
      CHECK(of(mesh, settings, 1).shares == h.shares);
    }
  }
}

TEST_CASE("as printed, half of the bins have numbers of 0 and less", "[histogram]") {
  for (unsigned seed = 0; seed < rounds(20); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const Mesh mesh = randomSurface(random, 6);
    const LargeVector<Point> normals = smoothNormals(mesh);
    const uint32_t bins = 1 + static_cast<uint32_t>(random() % 64);
    const Histogram h = of(mesh, {HistogramMode::printed, bins});
    // Evaluates equations 9 to 14 of the paper literally, with higher precision.
    std::map<long, uint64_t> counts;
    uint64_t below = 0, edges = 0;
    constexpr long double kPi = std::numbers::pi_v<long double>;
    for (const Triangle& t : mesh.triangles) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t v1 = t[k], v2 = t[(k + 1) % 3];
        long double e[3], size = 0, dot1 = 0, dot2 = 0;
        for (int axis = 0; axis < 3; ++axis) {
          e[axis] = static_cast<long double>(mesh.points[v2][axis]) - static_cast<long double>(mesh.points[v1][axis]);
          size += e[axis] * e[axis];
        }
        for (int axis = 0; axis < 3; ++axis) {
          dot1 += e[axis] / std::sqrt(size) * static_cast<long double>(normals[v1][axis]);
          dot2 += e[axis] / std::sqrt(size) * static_cast<long double>(normals[v2][axis]);
        }
        const long double d = std::acos(dot2) - std::acos(dot1);
        const long i = static_cast<long>(std::floor(d / (2 * (kPi + 1)) * bins)) + 1;
        ++counts[i];
        ++edges;
        below += i <= 0;
      }
    }
    CHECK(h.edges == edges);
    uint64_t differ = 0;
    for (const auto& [bin, count] : counts) {
      REQUIRE(bin >= h.first_bin);
      REQUIRE(bin < h.first_bin + static_cast<long>(h.shares.size()));
      const double share = h.shares[static_cast<size_t>(bin - h.first_bin)] * static_cast<double>(edges);
      differ += static_cast<uint64_t>(std::fabs(share - static_cast<double>(count)) + 0.5);
    }
    // An edge whose value equals a bin's boundary up to rounding may be counted on either side.
    CHECK(differ <= edges / 1000);
    if (edges > 0)
      CHECK(std::fabs(static_cast<double>(h.below_first) - static_cast<double>(below)) <=
            static_cast<double>(edges) / 1000);
  }
  CHECK(of(ball(2), {HistogramMode::printed, 10}).first_bin == -3);
  CHECK(of(ball(2), {HistogramMode::printed, 10}).shares.size() == 8);
  CHECK(of(ball(2), {HistogramMode::printed, 32}).first_bin == -12);
  CHECK(of(ball(2), {HistogramMode::printed, 32}).shares.size() == 26);
}

TEST_CASE("a ball is convex all over, its inside concave", "[histogram]") {
  Mesh mesh = ball(3);
  CHECK(of(mesh, {}).convex == 1);
  CHECK(of(mesh, {}).concave == 0);
  mesh.invert();
  CHECK(of(mesh, {}).concave == 1);
}

TEST_CASE("curvature stays as a mesh becomes finer, angles do not", "[histogram]") {
  for (int cuts = 2; cuts <= 5; ++cuts) {
    CAPTURE(cuts);
    // The curvature of a ball with radius 1 lies at 3/4 of the range: bin 75 of 99.
    const Histogram h = of(ball(cuts), {HistogramMode::curvature, 99});
    double near = 0;
    for (size_t i = 72; i < 76; ++i) near += h.shares[i];
    CHECK(near > 0.99);
  }
  const auto middleOf = [](int cuts) {
    const Histogram h = of(ball(cuts), {HistogramMode::corrected, 99});
    double middle = 0;
    for (size_t i = 0; i < h.shares.size(); ++i) middle += static_cast<double>(i) * h.shares[i];
    return middle;
  };
  CHECK(middleOf(2) > 53);
  CHECK(middleOf(5) < 50.5);
}

TEST_CASE("flat edges lie in one bin of an odd number, whatever the noise", "[histogram]") {
  std::mt19937 random(3);
  const Mesh mesh = flatGrid(40);
  std::vector<Point> normals;
  for (size_t i = 0; i < mesh.points.size(); ++i)
    normals.push_back(normalised(Point{between(random, -1e-6, 1e-6), between(random, -1e-6, 1e-6), 1}));
  const auto jobs = std::move(*makeThreadPool(1));
  const auto largest = [&](uint32_t bins) {
    const Histogram h = *histogramOf(mesh, normals, nullptr, {HistogramMode::corrected, bins}, *jobs);
    CHECK(h.flat == 1);
    return *std::max_element(h.shares.begin(), h.shares.end());
  };
  CHECK(largest(33) == Approx(1).margin(1e-12));
  CHECK(largest(9) == Approx(1).margin(1e-12));
  CHECK(largest(32) < 0.6);
}

TEST_CASE("edges without length and points without a normal are left out and counted", "[histogram]") {
  Mesh mesh = ball(1);
  mesh.points.push_back(mesh.points[0]);
  const auto copy = static_cast<uint32_t>(mesh.points.size() - 1);
  mesh.triangles.push_back({0, copy, 1});
  std::vector<Point> normals = mesh.points;
  normals[copy] = {};
  const auto jobs = std::move(*makeThreadPool(1));
  const Histogram h = *histogramOf(mesh, normals, nullptr, {}, *jobs);
  CHECK(h.left_out == 2);
  CHECK(h.edges == 3 * mesh.triangles.size() - 2);
  normals[0] = {std::nan(""), 0, 0};
  CHECK(histogramOf(mesh, normals, nullptr, {}, *jobs)->left_out > 2);
}

TEST_CASE("settings that cannot be", "[histogram]") {
  const Mesh mesh = ball(1);
  const auto jobs = std::move(*makeThreadPool(1));
  const auto refused = [&](const HistogramSettings& settings) {
    return histogramOf(mesh, mesh.points, nullptr, settings, *jobs).error().message;
  };
  CHECK(refused({HistogramMode::corrected, 0}) == "a histogram has 1 to 4096 bins, not 0: an odd number is best");
  CHECK(refused({HistogramMode::corrected, 5000}) == "a histogram has 1 to 4096 bins, not 5000: an odd number is best");
  CHECK(refused({HistogramMode::curvature, 33, 0}) == "the length that curvature is scaled by must be more than 0");
  CHECK(refused({HistogramMode::corrected, 33, 1, true}) ==
        "a histogram needs a normal for each point, and edges to count each once");
}

}  // namespace sgm::measure

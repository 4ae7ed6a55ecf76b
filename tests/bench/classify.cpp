// Measures how often models are classified correctly: models of every family with seeds and parameters from which no
// reference histogram was made, and meshes of noise, which must be unknown.
//
//   sgm_bench_classify [MODELS] [SEED]       MODELS: total number, the same for each class (default: 300)
//
// Fails if fewer than 95 % of the models are classified correctly.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numbers>
#include <random>
#include <string>

#include "backend/open/open_backend.h"
#include "base/hash.h"
#include "tools/classify/build.h"

namespace {

using namespace sgm;

struct Judge {
  masters::MasterSet set = masters::builtInMasters();
  measure::MasterKey key = masters::defaultKey();

  Result<measure::Classification> classify(const masters::ModelMesh& mesh, JobSystem& jobs) const {
    const auto histogram = measure::innerHistogram({mesh.points, mesh.triangles}, key.settings(), jobs);
    if (!histogram) return histogram.error();
    return measure::classify(histogram->shares, key, set.of(key), *set.limitsOf(key));
  }
};

[[noreturn]] void giveUp(const Error& error) {
  std::fprintf(stderr, "sgm_bench_classify: %s\n", error.message.c_str());
  std::exit(1);
}

/// Makes noise: a torus of quadrangles whose points are moved at random by up to `most` times an edge's length. It is a
/// closed mesh, but of no known class.
masters::ModelMesh noise(double edge, double most, unsigned seed) {
  constexpr uint32_t kAround = 96, kAcross = 32;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-most * edge, most * edge);
  const double turn = 2 * std::numbers::pi, inner = kAcross * edge / turn, outer = kAround * edge / turn;
  masters::ModelMesh mesh;
  for (uint32_t i = 0; i < kAround; ++i) {
    for (uint32_t j = 0; j < kAcross; ++j) {
      const double u = turn * i / kAround, v = turn * j / kAcross, r = outer + inner * std::cos(v);
      const double x = r * std::cos(u) + off(random), y = inner * std::sin(v) + off(random);
      mesh.points.push_back({x, y, r * std::sin(u) + off(random)});
      const uint32_t a = i * kAcross + j, b = i * kAcross + (j + 1) % kAcross;
      const uint32_t c = (i + 1) % kAround * kAcross + j, d = (i + 1) % kAround * kAcross + (j + 1) % kAcross;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  const uint64_t models = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 300;
  const uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0x48454C444F555421;
  const auto jobs = makeThreadPool(0);
  if (!jobs) giveUp(jobs.error());
  const auto backend = makeBackend(BackendRequest{}, **jobs, std::pmr::new_delete_resource());
  if (!backend) giveUp(backend.error());
  const Judge judge;
  std::map<std::string, std::map<std::string, uint64_t>> matrix;
  uint64_t right = 0, agreed = 0, total = 0;
  double least_margin = 1;
  const std::vector<std::string_view> classes = masters::classNames();
  for (const std::string_view class_name : classes) {
    std::vector<masters::ModelMaker> makers;
    for (const masters::Family& family : masters::families()) {
      if (family.class_name != class_name) continue;
      Result<masters::ModelMaker> maker = masters::ModelMaker::create(family);
      if (!maker) giveUp(maker.error());
      makers.push_back(std::move(*maker));
    }
    for (uint64_t i = 0; i < models / classes.size(); ++i) {
      // Take every seventh maker, so that even a few models come from all grammars, not only from the first one.
      const masters::ModelMaker& maker = makers[i * 7 % makers.size()];
      const auto mesh = maker.make(hashCombine(seed, i), **backend, **jobs);
      if (!mesh) giveUp(mesh.error());
      const auto said = judge.classify(*mesh, **jobs);
      if (!said) giveUp(said.error());
      ++matrix[std::string(class_name)][said->verdict];
      ++total;
      agreed += said->second_opinion == class_name;
      if (said->verdict == class_name) {
        ++right;
        least_margin = std::min(least_margin, said->margin);
        continue;
      }
      std::printf("%s at %g m, model %llu: %s, mse %.6f emd %.4f margin %.2f, second opinion %s\n",
                  std::string(maker.family().file).c_str(), maker.family().cell, static_cast<unsigned long long>(i),
                  said->verdict.c_str(), said->classes[0].mse, said->classes[0].emd, said->margin,
                  said->second_opinion.c_str());
    }
  }
  std::vector<std::string> columns(classes.begin(), classes.end());
  columns.emplace_back(measure::kUnknown);
  std::printf("%-10s", "");
  for (const std::string& column : columns) std::printf("%10s", column.c_str());
  for (const std::string_view row : classes) {
    std::map<std::string, uint64_t>& counts = matrix[std::string(row)];
    std::printf("\n%-10s", std::string(row).c_str());
    for (const std::string& column : columns) std::printf("%10llu", static_cast<unsigned long long>(counts[column]));
  }
  std::printf(
      "\n%llu of %llu right, %.1f %%; by the earth mover's distance alone %.1f %%; least margin of a right one %.2f\n",
      static_cast<unsigned long long>(right), static_cast<unsigned long long>(total),
      100.0 * static_cast<double>(right) / static_cast<double>(total),
      100.0 * static_cast<double>(agreed) / static_cast<double>(total), least_margin);

  uint64_t noises = 0, unknown = 0;
  const auto count = [&](const std::string& what, const masters::ModelMesh& mesh) {
    const auto said = judge.classify(mesh, **jobs);
    if (!said) giveUp(said.error());
    ++noises;
    unknown += said->verdict == measure::kUnknown;
    if (said->verdict != measure::kUnknown) std::printf("%s: %s\n", what.c_str(), said->verdict.c_str());
  };
  for (unsigned i = 0; i < 5; ++i) {
    for (const double edge : {0.25, 0.35, 0.5, 0.7, 1.0}) {
      for (const double most : {0.5, 0.7, 1.0, 2.0}) {
        count("torus of " + std::to_string(edge) + " m moved by " + std::to_string(most), noise(edge, most, i));
      }
    }
  }
  for (const masters::Family& family : masters::families()) {
    if (family.class_name != measure::kNoise) continue;
    const Result<masters::ModelMaker> maker = masters::ModelMaker::create(family);
    if (!maker) giveUp(maker.error());
    for (uint64_t i = 0; i < 5; ++i) {
      const auto mesh = maker->make(hashCombine(seed, i), **backend, **jobs);
      if (!mesh) giveUp(mesh.error());
      count(std::string(family.file) + " at " + std::to_string(family.cell) + " m", *mesh);
    }
  }
  std::printf("noise: %llu of %llu unknown\n", static_cast<unsigned long long>(unknown),
              static_cast<unsigned long long>(noises));
  return right * 100 >= total * 95 && unknown == noises ? 0 : 1;
}

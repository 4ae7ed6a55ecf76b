// Tests models of known class, and the reference histograms that are built from them.

#include "tools/classify/build.h"

#include <numeric>
#include <set>

#include "../catch.h"
#include "backend/open/open_backend.h"

namespace sgm::masters {
namespace {

/// Histograms with a peak whose place depends on the class, and slightly on the seed.
std::vector<Specimen> peaks() {
  std::vector<Specimen> specimens;
  for (const Family& family : families()) {
    const std::vector<std::string_view> names = classNames();
    const size_t peak = 8 + 4 * static_cast<size_t>(std::ranges::find(names, family.class_name) - names.begin());
    for (uint64_t i = 0; i < 4; ++i) {
      Specimen specimen{&family, i, {}};
      for (const measure::MasterKey& key : masterKeys()) {
        std::vector<double>& shares = specimen.shares.emplace_back(measure::binsOf(key.settings()));
        shares[peak % shares.size()] = 0.9 - 0.01 * static_cast<double>(i);
        shares[peak % shares.size() - 1] = 0.1 + 0.01 * static_cast<double>(i);
      }
      specimens.push_back(std::move(specimen));
    }
  }
  return specimens;
}

}  // namespace

TEST_CASE("every family's grammar compiles, and there are families of each class at each density",
          "[masters][costly]") {
  for (const Family& family : families()) {
    CAPTURE(family.file, family.cell);
    CHECK(ModelMaker::create(family));
  }
  for (const measure::MasterKey& key : masterKeys()) {
    std::set<std::string_view> classes;
    for (const Family& family : families()) {
      if (key.density == 0 || key.density * family.cell == 1) classes.insert(family.class_name);
    }
    CHECK(classes == std::set<std::string_view>{"building", "cave", "cloud", "noise", "terrain", "tree"});
  }
}

TEST_CASE("a model is its seed's, whatever the threads", "[masters]") {
  const Family* smallest = nullptr;
  for (const Family& family : families()) {
    if (family.file == "bench/storeys.sgm" && family.cell == 0.5) smallest = &family;
  }
  REQUIRE(smallest);
  const ModelMaker maker = *ModelMaker::create(*smallest);
  std::vector<ModelMesh> meshes;
  for (const auto& [seed, threads] : std::vector<std::pair<uint64_t, unsigned>>{{1, 1}, {1, 3}, {2, 1}}) {
    const auto jobs = std::move(*makeThreadPool(threads));
    const auto backend = std::move(*makeBackend(BackendRequest{}, *jobs, std::pmr::new_delete_resource()));
    meshes.push_back(*maker.make(seed, *backend, *jobs));
  }
  CHECK(meshes[0].triangles == meshes[1].triangles);
  CHECK(meshes[0].points.size() != meshes[2].points.size());
}

TEST_CASE("masters sum up to one, have names of their own, and limits that their models keep", "[masters]") {
  const std::vector<Specimen> specimens = peaks();
  const MasterSet set = mastersOf(specimens);
  REQUIRE(set.limits.size() == masterKeys().size());
  for (size_t k = 0; k < set.limits.size(); ++k) {
    const measure::MasterKey key = masterKeys()[k];
    const std::vector<measure::Master> masters = set.of(key);
    std::set<std::string> names;
    size_t models = 0;
    for (const measure::Master& master : masters) {
      CHECK(std::accumulate(master.shares.begin(), master.shares.end(), 0.0) == Approx(1).margin(1e-12));
      names.insert(master.name);
      models += master.models;
    }
    CHECK(names.size() == masters.size());
    CHECK(models == specimens.size());
    for (const Specimen& specimen : specimens) {
      const auto said = measure::classify(specimen.shares[k], key, masters, *set.limitsOf(key));
      REQUIRE(said);
      CHECK(said->classes[0].class_name == specimen.family->class_name);
    }
  }
  CHECK(sourceOf(set, "a test") == sourceOf(mastersOf(peaks()), "a test"));
}

}  // namespace sgm::masters

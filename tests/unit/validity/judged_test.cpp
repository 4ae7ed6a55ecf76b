// Tests random sharp solids with CGAL: the surfaces must be closed, manifold and oriented outward, without triangles of
// zero area and without intersections. tests/judges runs these tests; the environment variable SGM_JUDGE_CGAL names the
// program that checks the surfaces with CGAL.

#include <cstdio>
#include <cstdlib>

#include "../../judges/meshes.h"
#include "random_solids.h"

using namespace sgm;
using namespace sgm::test;

namespace {

/// Number of random solids. In the long run (SGM_LONG), 500 solids with two cell sizes each give a thousand surfaces.
unsigned solidsJudged() { return std::getenv("SGM_LONG") != nullptr ? 500 : 20; }

void judgeSolids(bool sharp) {
  const char* const judge = std::getenv("SGM_JUDGE_CGAL");
  REQUIRE(judge != nullptr);
  const ReportContext shop;
  measure::JudgedMeshes meshes;
  std::vector<std::pair<unsigned, bool>> ours;
  for (unsigned seed = 1; seed <= solidsJudged(); ++seed) {
    std::mt19937 random(seed);
    const std::shared_ptr<const Program> program = compiled(randomSolid(random));
    for (const double cell : kSolidCells) {
      const WorldField world(worldOf(program, cell, 1), std::pmr::get_default_resource());
      const int32_t most = 12 * kUnitsPerMetre;
      const MeshedRegion region = meshedRegion(world, shop, {{-most, -most, -most}, {most, most, most}}, sharp);
      if (region.mesh.triangles.empty()) continue;
      meshes.add({region.mesh.points, region.mesh.triangles});
      ours.emplace_back(seed, faultsOf(region.mesh, nullptr, *shop.jobs).valid);
    }
  }
  const auto verdicts = meshes.judge<measure::CgalVerdict>("'" + std::string(judge) + "'");
  REQUIRE(verdicts.size() == ours.size());
  size_t valid = 0;
  for (size_t i = 0; i < verdicts.size(); ++i) {
    const measure::CgalVerdict& theirs = verdicts[i];
    CAPTURE(ours[i].first, ours[i].second, theirs.manifold, theirs.closed, theirs.flat, theirs.pairs, theirs.outward,
            theirs.bounds);
    CHECK(theirs.valid());
    CHECK(theirs.valid() == ours[i].second);
    valid += theirs.valid();
  }
  std::printf("%s: CGAL finds %zu of %zu solids valid\n", sharp ? "sharp" : "plain", valid, verdicts.size());
  CHECK(verdicts.size() > solidsJudged());
}

}  // namespace

TEST_CASE("CGAL finds random solids valid", "[.][cgal][plain]") { judgeSolids(false); }

TEST_CASE("CGAL finds random sharp solids valid", "[.][cgal][sharp]") { judgeSolids(true); }

// Tests that every sample grammar gives a valid surface, with three cell sizes, sharp and not.
//
// While working on the mesher, SGM_VALIDITY_ONLY=muller test_sharp_validity "[table]" tests only the rows of grammars
// whose names contain "muller".

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "measured_surface.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::test;

namespace {

/// A box in metres, lo <= p < hi, with at most 512 chunks at every cell size.
struct Row {
  const char* grammar;
  std::array<double, 3> low, high;
};

constexpr double kCells[] = {0.5, 0.25, 0.125};
constexpr uint64_t kMaxChunks = 512;

const Row kRows[] = {
    {"arches", {-8, -8, -8}, {8, 8, 8}},
    {"basalt", {2, 0, 20}, {18, 16, 36}},
    {"branchwork", {48, -4, 56}, {64, 12, 72}},
    {"building", {-8, 0, -8}, {8, 16, 8}},
    {"castle", {-8, 16, 28}, {8, 32, 44}},
    {"cave", {20, -4, 24}, {36, 12, 40}},
    {"choice", {32, 0, 32}, {64, 8, 64}},
    {"city", {16, 0, 16}, {32, 16, 32}},
    {"cloud", {3024, 1408, 1484}, {3040, 1424, 1500}},
    {"combine", {-8, -8, -8}, {8, 8, 8}},
    {"desert", {48, 0, 80}, {64, 16, 96}},
    {"edits", {32, 48, 32}, {48, 64, 48}},
    {"houses", {8, -4, 8}, {24, 12, 24}},
    {"lake", {20, -6, 24}, {36, 10, 40}},
    {"lava_tube", {24, -4, 32}, {40, 12, 48}},
    {"morph", {-8, -8, -8}, {24, 8, 8}},
    {"nave", {-8, 0, -8}, {8, 16, 8}},
    {"passage", {16, 0, 0}, {32, 16, 16}},
    {"primitives", {-4, -4, -4}, {64, 4, 4}},
    {"sphere", {-8, -8, -8}, {8, 8, 8}},
    {"storeys", {-8, -4, -8}, {8, 12, 8}},
    {"terrace", {0, 0, -8}, {16, 16, 8}},
    {"terrain", {-16, -8, -16}, {0, 8, 0}},
    {"town", {10, 0, 24}, {26, 16, 40}},
    {"tree", {-8, 0, -8}, {8, 16, 8}},
    {"tunnels", {-32, -8, -8}, {-16, 8, 8}},
    {"valley", {100, 0, 60}, {116, 16, 76}},
    {"workings", {4, 8, 4}, {20, 24, 20}},
    {"table4/birger", {224, 896, 512}, {240, 912, 528}},
    {"table4/bouthors", {272, 1040, 480}, {288, 1056, 496}},
    {"table4/cabral", {-16, 0, -16}, {0, 16, 0}},
    {"table4/cui", {36, 32, 40}, {52, 48, 56}},
    {"table4/gkm", {0, -8, 0}, {16, 8, 16}},
    {"table4/greuter", {32, 0, 16}, {48, 16, 32}},
    {"table4/lipp", {-8, -4, -2}, {8, 12, 14}},
    {"table4/marson", {-8, -4, -8}, {8, 8, 8}},
    {"table4/muller", {-8, -16, -2}, {8, 0, 14}},
    {"table4/voxel", {-16, -16, -16}, {0, 0, 0}},
};

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file);
  REQUIRE(in);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

IntBox boxOf(const Row& row) {
  IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = static_cast<int32_t>(row.low[static_cast<size_t>(axis)] * kUnitsPerMetre);
    box.hi[axis] = static_cast<int32_t>(row.high[static_cast<size_t>(axis)] * kUnitsPerMetre);
  }
  return box;
}

bool isWanted(const std::string& grammar) {
  const char* const only = std::getenv("SGM_VALIDITY_ONLY");
  return only == nullptr || grammar.find(only) != std::string::npos;
}

/// Number of seeds for each grammar and cell size; twenty in the long run.
uint64_t seedsWanted() { return std::getenv("SGM_LONG") != nullptr ? 20 : 1; }

void checkTable(bool sharp) {
  const std::filesystem::path folder(SGM_SAMPLE_GRAMMARS);
  const ReportContext shop;
  std::printf("%-16s %5s %5s %6s %9s %10s %8s %6s %5s %7s %6s %7s\n", sharp ? "sharp" : "plain", "cell", "seed",
              "chunks", "triangles", "degenerate", "no area", "folded", "cuts", "3-edges", "others", "seconds");
  size_t rows = 0, invalid = 0;
  for (const Row& row : kRows) {
    if (!isWanted(row.grammar)) continue;
    const std::filesystem::path file = folder / (std::string(row.grammar) + ".sgm");
    const std::shared_ptr<const Program> program = compiled(textOf(file), file.parent_path());
    for (const double cell : kCells) {
      size_t triangles = 0;
      for (uint64_t seed = 1; seed <= seedsWanted(); ++seed) {
        CAPTURE(row.grammar, cell, seed, sharp);
        const auto start = std::chrono::steady_clock::now();
        const WorldField world(worldOf(program, cell, seed), std::pmr::get_default_resource());
        const MeshedRegion region = meshedRegion(world, shop, boxOf(row), sharp);
        CHECK(region.chunks <= kMaxChunks);
        triangles += region.mesh.triangles.size();
        // With many seeds, some worlds have no surface in such a small region.
        if (region.mesh.triangles.empty()) continue;
        const Faults faults = faultsOf(region.mesh, &region.cut, *shop.jobs);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        std::printf("%-16s %5g %5u %6u %9zu %10zu %8zu %6zu %5zu %7zu %6zu %7.2f%s\n", row.grammar, cell,
                    static_cast<unsigned>(seed), static_cast<unsigned>(region.chunks), faults.triangles,
                    faults.degenerate, faults.without_area, faults.folded, faults.cuts, faults.nonmanifold,
                    faults.others, seconds, faults.valid ? "" : "  INVALID");
        std::fflush(stdout);
        ++rows;
        invalid += !faults.valid;
        INFO(faults);
        CHECK(faults.valid);
      }
      CAPTURE(row.grammar, cell);
      CHECK(triangles > 100);
    }
  }
  std::printf("%zu rows, %zu invalid\n", rows, invalid);
  CHECK(rows > 0);
}

}  // namespace

TEST_CASE("the table has every sample grammar", "[validity]") {
  const std::filesystem::path folder(SGM_SAMPLE_GRAMMARS);
  std::set<std::string> found, listed;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".sgm") continue;
    found.insert(std::filesystem::relative(entry.path(), folder).replace_extension().generic_string());
  }
  for (const Row& row : kRows) listed.insert(row.grammar);
  CHECK(found == listed);
}

TEST_CASE("every sample grammar is valid as marching cubes make it", "[validity][table][plain][costly]") {
  checkTable(false);
}

TEST_CASE("every sample grammar is valid with sharp features", "[validity][table][sharp][costly]") { checkTable(true); }

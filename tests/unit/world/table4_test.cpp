// Tests the claims of rows of the paper's Table 4, with the samples that represent them (samples/grammars/table4). The
// samples' own `expect` statements test that they are closed and connected.

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "field/evaluate.h"
#include "rounds.h"
#include "seed.h"
#include "world_support.h"

using namespace sgm;

namespace {

/// The places of all uses of a rule.
std::vector<Int3> placesOf(const WorldField& world, std::string_view rule, const IntBox& box) {
  const auto found = world.instances(ruleNamed(*world.settings().program, rule), box, 100'000);
  INFO((found ? std::string() : found.error().message));
  REQUIRE(found);
  std::vector<Int3> places;
  for (const RuleInstance& one : *found) places.push_back(one.origin);
  return places;
}

/// The world's solid, without the objects in it.
class Rock {
 public:
  Rock(const WorldField& world, uint32_t layer, const IntBox& box) : program_(*world.compileBelow(layer, box)) {}
  bool solid(Int3 p) {
    int32_t q = 0;
    scalarKernels().samples(program_->view(), {&p.x, &p.y, &p.z, 1}, scratch_, &q);
    return q < 0;
  }

 private:
  std::shared_ptr<const FieldProgram> program_;
  EvalScratch scratch_;
};

WorldField cloudOf(double levels, uint64_t seed) {
  WorldFieldSettings settings = settingsOf(sample("table4/bouthors.sgm"), 1024, seed);
  REQUIRE(settings.parameters.set(*settings.program, "levels", levels));
  return {std::move(settings), std::pmr::get_default_resource()};
}

constexpr IntBox kCloud{{-100 * 1024, 500 * 1024, -100 * 1024}, {900 * 1024, 1400 * 1024, 900 * 1024}};

double distanceOf(Int3 a, Int3 b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

}  // namespace

TEST_CASE("Bouthors: blobs stand upon blobs, each level on the surface of the one before", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  const WorldField world = cloudOf(2, seed);
  const auto heaps = world.instances(ruleNamed(*world.settings().program, "Heap"), kCloud, 10'000);
  REQUIRE(heaps);
  std::map<std::string, Int3> places;
  for (const RuleInstance& heap : *heaps) places[heap.path] = heap.origin;
  // Key: path of a heap. Value: its distances to the heaps that stand on it.
  std::map<std::string, std::vector<double>> away;
  std::vector<std::string> first;  // path of the first heap of each cloud
  for (const auto& [path, place] : places) {
    const std::string below = path.substr(0, path.rfind('/'));
    const auto parent = places.find(below);
    if (parent == places.end()) {
      first.push_back(path);
      continue;
    }
    away[below].push_back(distanceOf(place, parent->second));
  }
  REQUIRE(!away.empty());
  for (const auto& [path, distances] : away) {
    CAPTURE(path);
    CHECK(distances.size() == 6);
    const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
    CHECK(*most - *least <= 8);
    const std::string below = path.substr(0, path.rfind('/'));
    if (away.count(below) == 0) continue;
    const double share = distances[0] / away.at(below)[0];
    CHECK(share > 0.35 - 1e-3);
    CHECK(share < 0.6 + 1e-3);
  }
  // A tall cloud has three levels of heaps; each heap stands on a heap of the level below. The small clouds at the foot
  // of a tall cloud have two levels. Of neighbouring clouds, the box may contain no more than the first heap.
  size_t grown = 0, tall = 0;
  for (const std::string& path : first) {
    if (away.count(path) == 0) continue;
    const auto upon = away.upper_bound(path);
    const bool is_tall = upon != away.end() && upon->first.starts_with(path + "/");
    tall += is_tall ? 1u : 0u;
    grown += is_tall ? 7u : 1u;
  }
  CHECK(tall >= 1);
  CHECK(away.size() == grown);
}

TEST_CASE("Bouthors: more levels only add, and from afar there are fewer", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  const WorldField few = cloudOf(1, seed), many = cloudOf(3, seed);
  const auto less = few.compile(kCloud, 0), more = many.compile(kCloud, 0);
  REQUIRE(less);
  REQUIRE(more);
  std::uniform_int_distribution<int32_t> x(0, 800 * 1024), y(650 * 1024, 1200 * 1024);
  std::vector<int32_t> at[3];
  for (unsigned i = 0; i < 1000 * rounds(40); ++i)
    at[0].push_back(x(random)), at[1].push_back(y(random)), at[2].push_back(x(random));
  const Points points{at[0].data(), at[1].data(), at[2].data(), at[0].size()};
  std::vector<int32_t> q_less(points.count), q_more(points.count);
  EvalScratch scratch;
  scalarKernels().samples((*less)->view(), points, scratch, q_less.data());
  scalarKernels().samples((*more)->view(), points, scratch, q_more.data());
  size_t lost = 0, won = 0;
  for (size_t i = 0; i < points.count; ++i) {
    lost += q_less[i] < 0 && q_more[i] >= 0 ? 1u : 0u;
    won += q_less[i] >= 0 && q_more[i] < 0 ? 1u : 0u;
  }
  CHECK(lost == 0);
  CHECK(won > 0);
  // The world has a single cloud, because at coarser levels more of the neighbouring clouds would reach into the box.
  const WorldField one(many.settings(), *many.cell(0, {0, 0, 0}), std::pmr::get_default_resource());
  const IntBox all{{-4096 * 1024, -4096 * 1024, -4096 * 1024}, {4096 * 1024, 4096 * 1024, 4096 * 1024}};
  std::vector<size_t> sizes;
  for (int level = 0; level <= 7; ++level) {
    const auto program = one.compile(all, level);
    REQUIRE(program);
    sizes.push_back((*program)->instrs.size());
  }
  CHECK(std::is_sorted(sizes.rbegin(), sizes.rend()));
  CHECK(20 * sizes.back() < sizes.front());
}

namespace {

/// Statistics of a layer of clouds along lines in its middle plane: the share of the lines in clouds, and how often
/// lines enter or leave a cloud.
struct Cut {
  double share = 0, crossings = 0;
};

Cut cutOf(double cover, double octaves, uint64_t seed) {
  WorldFieldSettings settings = settingsOf(sample("table4/birger.sgm"), 4096, seed);
  REQUIRE(settings.parameters.set(*settings.program, "cover", cover));
  REQUIRE(settings.parameters.set(*settings.program, "octaves", octaves));
  const WorldField world(std::move(settings), std::pmr::get_default_resource());
  // The number of patches is large enough that random differences in the clouds' cover average out. Each patch is
  // evaluated with its own program.
  constexpr int32_t kPatches = 20, kEdge = 400 * 1024, kStep = 8 * 1024, kLines = 4, kAlong = kEdge / kStep;
  std::vector<int32_t> x(kAlong), y(kAlong, 900 * 1024), z(kAlong), q(kAlong);
  EvalScratch scratch;
  size_t cloud = 0, crossings = 0;
  for (int32_t patch = 0; patch < kPatches * kPatches; ++patch) {
    const int32_t left = patch % kPatches * kEdge, front = patch / kPatches * kEdge;
    const auto program = world.compile({{left, 899 * 1024, front}, {left + kEdge, 901 * 1024, front + kEdge}}, 0);
    REQUIRE(program);
    for (int32_t line = 0; line < kLines; ++line) {
      for (int32_t i = 0; i < kAlong; ++i) {
        x[static_cast<size_t>(i)] = left + i * kStep;
        z[static_cast<size_t>(i)] = front + line * (kEdge / kLines);
      }
      scalarKernels().samples((*program)->view(), {x.data(), y.data(), z.data(), x.size()}, scratch, q.data());
      for (size_t i = 0; i < q.size(); ++i) {
        cloud += q[i] < 0 ? 1u : 0u;
        crossings += i > 0 && (q[i] < 0) != (q[i - 1] < 0) ? 1u : 0u;
      }
    }
  }
  const double all = double{kPatches} * kPatches * kLines * kAlong;
  return {static_cast<double>(cloud) / all, static_cast<double>(crossings) / all};
}

}  // namespace

TEST_CASE("Birger: noise covers as much of the sky as is asked for, and is as fine as its octaves", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  for (const double cover : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const Cut cut = cutOf(cover, 5, seed);
    CAPTURE(cover, cut.share);
    CHECK(std::fabs(cut.share - cover) < 0.08);
  }
  double before = 0;
  for (const double octaves : {1.0, 2.0, 4.0}) {
    const Cut cut = cutOf(0.5, octaves, seed);
    CAPTURE(octaves, cut.share, cut.crossings);
    CHECK(cut.crossings > 1.08 * before);
    before = cut.crossings;
  }
}

TEST_CASE("Cui: what drips hangs from ceilings, stands on floors, and joins the two", "[table4]") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  size_t hanging = 0, standing = 0, joining = 0;
  // Columns are rare, so rounds continue until one was found.
  for (unsigned round = 0; round < rounds(3) || (joining == 0 && round < 40); ++round) {
    const WorldField world(settingsOf(sample("table4/cui.sgm"), 512, random()), std::pmr::get_default_resource());
    const int32_t far = static_cast<int32_t>(random() % 2000) * 1024;
    const IntBox box{{far, 0, -far}, {far + 96 * 1024, 96 * 1024, -far + 96 * 1024}};
    IntBox around = box;
    for (int axis = 0; axis < 3; ++axis) around.lo[axis] -= 1024, around.hi[axis] += 1024;
    Rock rock(world, 0, around);
    for (const char* rule : {"Stalactite", "Column"}) {
      const std::vector<Int3> places = placesOf(world, rule, box);
      (rule[0] == 'S' ? hanging : joining) += places.size();
      CHECK(std::all_of(places.begin(), places.end(), [&](Int3 p) { return rock.solid(p); }));
      CHECK(std::none_of(places.begin(), places.end(), [&](Int3 p) { return rock.solid({p.x, p.y - 1, p.z}); }));
    }
    const std::vector<Int3> floors = placesOf(world, "Stalagmite", box);
    standing += floors.size();
    CHECK(std::all_of(floors.begin(), floors.end(), [&](Int3 p) { return rock.solid(p); }));
    CHECK(std::none_of(floors.begin(), floors.end(), [&](Int3 p) { return rock.solid({p.x, p.y + 1, p.z}); }));
  }
  CAPTURE(hanging, standing, joining);
  CHECK(hanging > 0);
  CHECK(standing > 0);
  CHECK(joining > 0);
}

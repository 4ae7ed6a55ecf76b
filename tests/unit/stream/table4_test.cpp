// What the rows of the paper's Table 4 claim, of the samples that stand for them (samples/grammars/table4). That they
// are closed and connected they say themselves (expect).

#include <algorithm>
#include <random>

#include "field/evaluate.h"
#include "rounds.h"
#include "world_support.h"

using namespace sgm;

namespace {

uint32_t ruleNamed(const Program& program, std::string_view name) {
  for (uint32_t r = 0; r < program.rules.size(); ++r) {
    if (program.text(program.rules[r].name) == name) return r;
  }
  FAIL("no such rule");
  return 0;
}

/// Where each use of a rule stands.
std::vector<Int3> placesOf(const WorldField& world, std::string_view rule, const IntBox& box) {
  const auto found = world.instances(ruleNamed(*world.settings().program, rule), box, 100'000);
  INFO((found ? std::string() : found.error().message));
  REQUIRE(found);
  std::vector<Int3> places;
  for (const RuleInstance& one : *found) places.push_back(one.origin);
  return places;
}

/// The world without what was placed in it.
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

}  // namespace

TEST_CASE("Cui: what drips hangs from ceilings, stands on floors, and joins the two", "[table4]") {
  const unsigned seed = std::random_device()();
  CAPTURE(seed);
  std::mt19937 random(seed);
  size_t hanging = 0, standing = 0, joining = 0;
  for (unsigned round = 0; round < rounds(3); ++round) {
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

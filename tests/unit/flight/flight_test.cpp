// Tests flights through streamed worlds: their digs, and the reports about them.

#include "tools/flight/flight.h"

#include "drawn_world.h"
#include "fixture.h"

using namespace sgm;
using cli::FlightPath;
using cli::FlightReport;
using cli::FlightSettings;
using cli::Spread;

namespace {

/// A closed cave for one flight.
struct CaveFlight {
  RuntimeOwner runtime = makeRuntime();
  GrammarOwner grammar = compile(runtime.get(), kClosedWorlds[1]);
  FieldOwner field = makeField(runtime.get(), grammar.get(), kFinestCell);
  WorldOwner world;
  FlightSettings settings;

  explicit CaveFlight(double collider_distance = cli::kWalkableDistance) {
    sgm_world_desc desc = SGM_WORLD_DESC_INIT;
    desc.top_level = kTop;
    desc.finest_distance = 12;
    desc.view_distance = 150;
    desc.collider_distance = collider_distance;
    sgm_world* made = nullptr;
    sgm_error error = SGM_ERROR_INIT;
    const sgm_result result = sgm_world_create(field.get(), &desc, &made, &error);
    INFO(error.message);
    REQUIRE(result == SGM_OK);
    world.reset(made);
    settings.cell_units = kFinestCell;
    settings.frames = 180;
    settings.finest_distance = 8;
    settings.check = true;
    settings.paced = false;
  }

  FlightReport fly() {
    Result<FlightPath> path = FlightPath::automatic(field.get(), grammar.get(), {});
    REQUIRE(path);
    const Result<FlightReport> report = cli::fly(world.get(), *path, settings, {});
    INFO((report ? "" : report.error().message));
    REQUIRE(report);
    return *report;
  }
  uint64_t hash() {
    const int32_t low[3] = {-60 * 1024, -60 * 1024, -60 * 1024}, high[3] = {60 * 1024, 60 * 1024, 60 * 1024};
    uint64_t hash = 0;
    REQUIRE(sgm_world_hash(world.get(), low, high, 1, &hash, nullptr) == SGM_OK);
    return hash;
  }
};

}  // namespace

TEST_CASE("a flight that digs draws each dig soon, closed, and makes the same world however fast it flies") {
  CaveFlight flight, paced, untouched;
  flight.settings.edits = paced.settings.edits = 10;
  flight.settings.teleports = paced.settings.teleports = 2;
  paced.settings.paced = true;
  const FlightReport report = flight.fly(), other = paced.fly();
  for (const FlightReport& r : {report, other}) {
    CHECK(r.frames == 180);
    // There are ten digs per second, from one second after the start of the flight on.
    CHECK(r.digs.digs() == 20);
    CHECK(r.digs.cuts > r.digs.adds + r.digs.undos);
    CHECK(r.digs.undos > 0);
    CHECK(r.digs.frames.max <= 2);
    CHECK(r.digs.milliseconds.max > 0);
    CHECK(r.stats.edits == 20);
    CHECK(r.checked.worst.edges > 1000);
    CHECK(r.checked.worst.closed());
    CHECK(r.checked.whole_checks == 1);
    CHECK(r.checked.whole_failures == 0);
    CHECK(r.colliders.colliders > 0);
    CHECK(r.colliders.fit());
    CHECK(r.peak_handed_over > 0);
    CHECK(r.peak_handed_over <= flight.settings.frame_bytes);
    CHECK(r.work_at_teleports.size() == 2);
  }
  CHECK(other.digs.frames.max > 0);
  CHECK(other.walkable_ms >= 0);
  CHECK(report.stale.empty());
  for (const double share : other.stale) CHECK((share >= 0 && share <= 1));
  CHECK(flight.hash() == paced.hash());
  CHECK(flight.hash() != untouched.hash());
}

TEST_CASE("without colliders nobody walks, and that is reported") {
  CaveFlight flight(0);
  const FlightReport report = flight.fly();
  CHECK(report.walkable_ms < 0);
  CHECK(report.colliders.colliders == 0);
  CHECK(report.colliders.missing > 0);
  CHECK_FALSE(report.colliders.fit());
  CHECK(report.digs.digs() == 0);
}

TEST_CASE("a spread says the middle, what one in a hundred exceeds, and the largest") {
  std::vector<double> values;
  for (int i = 0; i <= 200; ++i) values.push_back((i * 77) % 201);
  const Spread spread = cli::spreadOf(values);
  CHECK(spread.p50 == 100);
  CHECK(spread.p99 == 198);
  CHECK(spread.max == 200);
  CHECK(cli::spreadOf({}).max == 0);
  CHECK(cli::spreadOf({3}).p99 == 3);
}

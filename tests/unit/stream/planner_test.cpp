// Tests the requests of a plan: each chunk once, with all its seams, whatever the previous plans were.

#include <algorithm>
#include <optional>
#include <random>
#include <set>

#include "catch.h"
#include "rounds.h"
#include "stream/plan/planner.h"

using namespace sgm;

namespace {

constexpr int32_t kPlannedCell = 512;

PlannerSettings plannerSettings(bool by_reach) {
  PlannerSettings settings;
  settings.lod.top = 4;
  settings.lod.finest_cell = kPlannedCell;
  settings.lod.finest_distance = 30.0 * kUnitsPerMetre;
  settings.lod.view_distance = 200.0 * kUnitsPerMetre;
  settings.by_reach = by_reach;
  return settings;
}

/// A surface without geometry, of which only the number of bytes and the seams are used.
std::shared_ptr<const ChunkSurface> surfaceFor(const ChunkRequest& request, const ChunkSurface* before) {
  ChunkSurface surface(std::pmr::get_default_resource());
  surface.key = request.key;
  surface.seams = static_cast<uint8_t>(request.seams | (before != nullptr ? before->seams : 0));
  surface.mesh.indices.resize(3);
  surface.hash.a = surface.seams;
  return std::make_shared<const ChunkSurface>(std::move(surface));
}

}  // namespace

TEST_CASE("a plan asks for each chunk once, and what it offers is whole") {
  for (uint32_t seed = 1; seed <= rounds(6); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Planner planner(plannerSettings(seed % 2 == 0));
    std::vector<WorkItem> queue;
    WorldState edits, under;
    std::vector<WorldChange> edited;
    std::vector<std::shared_ptr<const FrameStep>> offered;  // offered steps that the engine may take
    PlanInput input;
    Viewer viewer;
    uint64_t frames = 0;
    for (int turn = 0; turn < 150; ++turn) {
      if (random() % 6 == 0) {
        for (double& p : viewer.position) p += static_cast<double>(random() % 40001) - 20000.0;
      }
      if (random() % 8 == 0) {
        const Int3 place{static_cast<int32_t>(viewer.position[0]), static_cast<int32_t>(viewer.position[1]),
                         static_cast<int32_t>(viewer.position[2])};
        edited.push_back({++edits.number, IntBox{place, place}.grown(static_cast<int32_t>(random() % 20000))});
      }
      input.viewers = {viewer};
      input.edits = edits;
      input.edited.clear();
      for (const WorldChange& box : edited) {
        if (box.number > planner.edits().number) input.edited.push_back(box);
      }
      Plan plan = planner.plan(std::move(input));
      std::set<ChunkKey> asked;
      for (const WorkItem& item : plan.queue) {
        CHECK(asked.insert(item.request.key).second);
        CHECK((item.request.body || item.request.seams != 0));
      }
      if (plan.step != nullptr) {
        CHECK(plan.step->to->edits == plan.edits.number);
        for (const DrawnChunk& chunk : plan.step->to->drawn) {
          CHECK((chunk.seams & ~chunk.surface->seams) == 0);
        }
      }
      queue = std::move(plan.queue);
      under = plan.edits;
      // Of the steps offered so far, the engine can still take those that begin at the frame it draws now. Simulates an
      // engine that holds at most two of them.
      std::erase_if(offered, [&](const auto& step) { return step->from != planner.applied().number; });
      std::shuffle(offered.begin(), offered.end(), random);
      if (offered.size() > 2) offered.resize(2);
      input = {};
      for (size_t i = 0; i < offered.size(); ++i) input.in_hand[i] = offered[i]->to->number;
      if (plan.step != nullptr) offered.push_back(plan.step);
      input.applied = planner.applied().number;
      // Memory sometimes seems to be full, so that the planner drops all chunks that are not wanted.
      input.live_bytes = random() % 3 == 0 ? size_t{200} << 20 : 0;
      if (!offered.empty() && random() % 2 == 0) {
        input.applied = offered[random() % offered.size()]->to->number;
        ++frames;
      }
      for (auto jobs = random() % 120; jobs > 0 && !queue.empty(); --jobs) {
        const WorkItem item = queue.back();
        queue.pop_back();
        FinishedChunk done;
        done.request = item.request;
        done.before = item.before;
        done.edits = under.number;
        if (random() % 4 != 0) done.surface = surfaceFor(item.request, item.before.get());
        if (item.request.body == false && item.before == nullptr) done.surface = nullptr;
        input.begun.push_back(item.request.key);
        input.finished.push_back(std::move(done));
      }
    }
    CHECK(frames > 5);
  }
}

TEST_CASE("edits without viewers leave nothing to do") {
  Planner planner(plannerSettings(false));
  WorldState edits;
  for (int turn = 0; turn < 4; ++turn) {
    PlanInput input;
    input.edits = {++edits.number, nullptr};
    input.edited.push_back({edits.number, IntBox{{0, 0, 0}, {1000, 1000, 1000}}});
    CHECK(planner.plan(std::move(input)).idle);
  }
}

TEST_CASE("an edited chunk that cannot be made keeps the edits back, and nothing else") {
  Planner planner(plannerSettings(false));
  WorldState edits;
  std::optional<WorldChange> pending;
  bool fails = false;
  Viewer viewer;
  /// Plans and meshes until no requests are left.
  const auto settle = [&] {
    PlanInput input;
    for (int turn = 0; turn < 500; ++turn) {
      input.viewers = {viewer};
      input.edits = edits;
      if (pending && pending->number > planner.edits().number) input.edited = {*pending};
      Plan plan = planner.plan(std::move(input));
      input = {};
      input.applied = plan.step != nullptr ? plan.step->to->number : planner.applied().number;
      for (const WorkItem& item : plan.queue) {
        FinishedChunk done;
        done.request = item.request;
        done.before = item.before;
        done.edits = plan.edits.number;
        done.surface = surfaceFor(item.request, item.before.get());
        if (fails && item.rank == WorkItem::Rank::edited) done.error = Error{Code::limit, "too large"};
        input.begun.push_back(item.request.key);
        input.finished.push_back(std::move(done));
      }
      if (plan.idle) return true;
    }
    return false;
  };
  REQUIRE(settle());
  const auto dig = [&] { pending = WorldChange{++edits.number, IntBox{{0, 0, 0}, {1000, 1000, 1000}}}; };
  fails = true;
  dig();
  REQUIRE(settle());
  CHECK(planner.stats().failed > 0);
  CHECK(planner.stats().edits_drawn == 0);
  const uint64_t frame = planner.applied().number;
  viewer.position[0] += 200.0 * kUnitsPerMetre;
  REQUIRE(settle());
  CHECK(planner.applied().number > frame);
  // The next edit must mesh the failed chunks again.
  viewer.position[0] = 0;
  fails = false;
  dig();
  REQUIRE(settle());
  CHECK(planner.stats().edits_drawn == edits.number);
}

namespace {

/// Plans for a viewer, meshes a number of the requested chunks after each plan, and takes each offered step.
class Flight {
 public:
  explicit Flight(bool by_reach) : planner(plannerSettings(by_reach)) {}

  void plan(size_t chunks) {
    input_.viewers = {viewer};
    input_.edits = edits;
    input_.edited.clear();
    for (const WorldChange& change : changes) {
      if (change.number > planner.edits().number) input_.edited.push_back(change);
    }
    Plan plan = planner.plan(std::move(input_));
    input_ = {};
    input_.applied = plan.step != nullptr ? plan.step->to->number : planner.applied().number;
    idle = plan.idle;
    for (; chunks > 0 && !plan.queue.empty(); --chunks) {
      FinishedChunk done;
      done.request = plan.queue.back().request;
      done.before = plan.queue.back().before;
      done.edits = plan.edits.number;
      done.surface = surfaceFor(done.request, done.before.get());
      plan.queue.pop_back();
      input_.begun.push_back(done.request.key);
      input_.finished.push_back(std::move(done));
    }
  }
  void dig() {
    const Int3 place{static_cast<int32_t>(viewer.position[0]), static_cast<int32_t>(viewer.position[1]),
                     static_cast<int32_t>(viewer.position[2])};
    changes.push_back({++edits.number, IntBox{place, place}.grown(1500)});
  }

  Planner planner;
  Viewer viewer;
  WorldState edits;
  std::vector<WorldChange> changes;
  bool idle = false;

 private:
  PlanInput input_;
};

}  // namespace

TEST_CASE("digs that come with every plan keep nothing from being drawn") {
  for (const bool by_reach : {false, true}) {
    Flight flight(by_reach);
    for (int turn = 0; turn < 400; ++turn) {
      flight.dig();
      flight.plan(20);
    }
    CHECK(flight.planner.applied().number > 0);
    // The planner must draw level 0 around the viewer, and must draw digs soon after they were made.
    CHECK(flight.planner.applied().tree.isSplit({1, {0, 0, 0}}));
    CHECK(flight.edits.number - flight.planner.stats().edits_drawn < 100);
  }
}

TEST_CASE("what is known over new ground does not grow, and what is wanted is kept", "[costly]") {
  Flight flight(false);
  for (int turn = 0; turn < 500 && !flight.idle; ++turn) flight.plan(200);
  REQUIRE(flight.idle);
  const size_t wanted = flight.planner.stats().records;
  size_t most = 0;
  for (int turn = 0; turn < 3000; ++turn) {
    flight.viewer.position[0] += 1.0 * kUnitsPerMetre;
    flight.plan(200);
    most = std::max(most, flight.planner.stats().records);
  }
  CHECK(flight.planner.stats().meshed > 10 * wanted);
  // The planner keeps records of at most twice as many chunks as it needs, and of 1,024 more. It counts the records
  // only every 16 plans, so that there may be more between two counts.
  CHECK(most < 4 * wanted + 2048);
  for (int turn = 0; turn < 500 && !flight.idle; ++turn) flight.plan(200);
  REQUIRE(flight.idle);
  CHECK(flight.planner.stats().record_bytes > 0);
  const uint64_t meshed = flight.planner.stats().meshed;
  // Chunks that the viewer has just left are still known, so few chunks are meshed again.
  flight.viewer.position[0] -= 20.0 * kUnitsPerMetre;
  for (int turn = 0; turn < 100; ++turn) flight.plan(200);
  REQUIRE(flight.idle);
  CHECK(flight.planner.stats().meshed < meshed + 60);
}

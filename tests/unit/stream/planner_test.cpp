// What a plan asks for: each chunk once, with all its seams, whatever came before.

#include <random>
#include <set>

#include "catch.h"
#include "rounds.h"
#include "stream/planner.h"

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

/// A surface of which only the number of bytes and the seams matter.
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
    EditState edits, under;
    std::vector<EditedBox> edited;
    std::shared_ptr<const FrameStep> step;
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
      for (const EditedBox& box : edited) {
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
      step = plan.step;
      input = {};
      input.applied = planner.applied().number;
      if (step != nullptr && random() % 2 == 0) {
        input.applied = step->to->number;
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

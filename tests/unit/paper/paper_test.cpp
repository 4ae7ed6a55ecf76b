// Tests the measurements of `sgm bench paper`, and its remarks on the paper's own figures.

#include <algorithm>
#include <random>

#include "backend/cpu/cpu_backend.h"
#include "catch.h"
#include "rounds.h"
#include "tools/paper/printed.h"
#include "tools/paper/stage.h"

using namespace sgm;
using namespace sgm::cli;

namespace {

constexpr int32_t kCell = 1024;  // cell size in units, with which the building's cube has eight chunks

constexpr uint64_t kNever = ~uint64_t{0};

/// A backend that meshes as the CPU does, but reverses a triangle in one batch. It reports that the CPU has meshed two
/// chunks of every batch in its place.
class LyingBackend final : public Backend {
 public:
  LyingBackend(std::shared_ptr<Backend> honest, uint64_t lie_at) : honest_(std::move(honest)), lie_at_(lie_at) {}
  const BackendCapabilities& capabilities() const override { return honest_->capabilities(); }
  BackendCounters counters() const override {
    BackendCounters counters;
    counters.on_cpu = 2 * batches_;
    return counters;
  }
  Result<std::unique_ptr<ChunkBatch>> submit(std::vector<ChunkJob> jobs, AfterChunk after_chunk) override {
    Result<std::unique_ptr<ChunkBatch>> batch = honest_->submit(std::move(jobs), std::move(after_chunk));
    if (!batch) return batch.error();
    return std::unique_ptr<ChunkBatch>(std::make_unique<Batch>(std::move(*batch), batches_++ == lie_at_));
  }

 private:
  class Batch final : public ChunkBatch {
   public:
    Batch(std::unique_ptr<ChunkBatch> honest, bool lies) : honest_(std::move(honest)), lies_(lies) {}
    bool poll() override { return honest_->poll(); }
    void wait() override { honest_->wait(); }
    void cancel() override { honest_->cancel(); }
    Result<std::vector<ChunkMesh>> take() override {
      Result<std::vector<ChunkMesh>> meshes = honest_->take();
      if (!meshes || !lies_) return meshes;
      const auto with_surface =
          std::find_if(meshes->begin(), meshes->end(), [](const ChunkMesh& m) { return !m.body.indices.empty(); });
      REQUIRE(with_surface != meshes->end());
      std::swap(with_surface->body.indices[0], with_surface->body.indices[1]);
      hashPart(with_surface->body);
      return meshes;
    }

   private:
    std::unique_ptr<ChunkBatch> honest_;
    bool lies_;
  };

  std::shared_ptr<Backend> honest_;
  uint64_t lie_at_, batches_ = 0;
};

BackendRun backend_run(const char* name, const char* instruction_set, unsigned threads) {
  BackendRun made;
  made.name = name;
  made.device = instruction_set;
  made.workers = threads;
  made.jobs = std::move(*makeThreadPool(threads));
  made.backend = std::move(*makeCpuBackend(instruction_set, *made.jobs, std::pmr::new_delete_resource(), {}));
  return made;
}

BackendRun absent() {
  BackendRun made;
  made.name = "absent";
  made.reason = "nobody made it";
  return made;
}

const StageModel& building() { return stageModels()[2]; }

}  // namespace

TEST_CASE("the stages are those of the paper, and every one has a surface") {
  REQUIRE(stageModels().size() == kPaperStages.size());
  const BackendRun backend_runs[] = {backend_run("sequential", "scalar", 1)};
  for (size_t i = 0; i < stageModels().size(); ++i) {
    CAPTURE(i);
    const StageModel& model = stageModels()[i];
    CHECK(model.name == kPaperStages[i].name);
    const Result<StageResult> result = measureStage(model, model.edge * kUnitsPerMetre / 32, 1, backend_runs, [] {});
    REQUIRE(result);
    CHECK(result->triangles > 100);
    CHECK(result->operations > result->triangles);
  }
}

TEST_CASE("all contenders run as often, and what is absent does not") {
  const BackendRun backend_runs[] = {backend_run("sequential", "scalar", 1), absent(), backend_run("parallel", "", 2)};
  size_t steps = 0;
  const Result<StageResult> result = measureStage(building(), kCell, 3, backend_runs, [&] { ++steps; });
  REQUIRE(result);
  CHECK(steps == 8);  // the count includes the first runs, which are not measured
  CHECK(result->rows[0].seconds.size() == 3);
  CHECK(result->rows[1].seconds.empty());
  CHECK(result->rows[2].seconds.size() == 3);
  CHECK(result->rows[2].median() > 0);
  CHECK(result->rows[2].first > 0);
  CHECK(result->chunks > 0);
  CHECK(result->hash != ContentHash{});
}

TEST_CASE("operations are those of the stage, whoever counts them") {
  const BackendRun one[] = {backend_run("sequential", "", 1)};
  const BackendRun two[] = {backend_run("sequential", "scalar", 1), backend_run("parallel", "", 3)};
  const Result<StageResult> a = measureStage(building(), kCell, 1, one, [] {});
  const Result<StageResult> b = measureStage(building(), kCell, 1, two, [] {});
  const Result<StageResult> finer = measureStage(building(), kCell / 2, 1, one, [] {});
  REQUIRE((a && b && finer));
  CHECK(a->operations == b->operations);
  CHECK(finer->operations > a->operations);
}

TEST_CASE("a run with another mesh is an error that names both backends") {
  for (uint64_t lie_at : {0u, 1u, 3u}) {
    CAPTURE(lie_at);
    BackendRun backend_runs[] = {backend_run("honest", "scalar", 1), backend_run("liar", "scalar", 1)};
    const Result<StageResult> agreed = measureStage(building(), kCell * 32, 3, backend_runs, [] {});
    REQUIRE(agreed);
    REQUIRE(agreed->triangles > 0);
    backend_runs[1].backend = std::make_shared<LyingBackend>(backend_runs[1].backend, lie_at);
    const Result<StageResult> result = measureStage(building(), kCell * 32, 3, backend_runs, [] {});
    REQUIRE_FALSE(result);
    CHECK(result.error().code == Code::bad_input);
    CHECK(result.error().message.find("building: the meshes differ: honest (scalar) makes ") == 0);
    CHECK(result.error().message.find("and liar (scalar) makes ") != std::string::npos);
  }
}

TEST_CASE("what a device leaves to the CPU is told of each") {
  BackendRun backend_runs[] = {backend_run("cpu", "scalar", 1), backend_run("device", "scalar", 1)};
  backend_runs[1].backend = std::make_shared<LyingBackend>(backend_runs[1].backend, kNever);
  const Result<StageResult> result = measureStage(building(), kCell * 32, 3, backend_runs, [] {});
  REQUIRE(result);
  CHECK(result->rows[0].on_cpu == 0);
  // There are four runs of one batch each, and two chunks of every batch count as meshed by the CPU.
  CHECK(result->rows[1].on_cpu == 8);
}

TEST_CASE("errors name the stage and the contender") {
  const BackendRun backend_runs[] = {backend_run("sequential", "scalar", 1)};
  const Result<StageResult> result = measureStage(building(), 1, 1, backend_runs, [] {});
  REQUIRE_FALSE(result);
  CHECK(result.error().code == Code::limit);
  CHECK(result.error().message.find("building: sequential: ") == 0);
  const BackendRun nobody[] = {absent()};
  CHECK_FALSE(measureStage(building(), kCell, 1, nobody, [] {}));
}

TEST_CASE("the median is the middle of the times, in any order") {
  std::mt19937 random(7);
  for (unsigned count = 1; count <= rounds(50); ++count) {
    CAPTURE(count);
    StageRow row;
    for (unsigned i = 1; i <= count; ++i) row.seconds.push_back(i);
    std::shuffle(row.seconds.begin(), row.seconds.end(), random);
    CHECK(row.median() == (1 + count) / 2.0);
  }
}

TEST_CASE("what is inconsistent in the paper's tables is told in numbers") {
  const std::vector<Contradiction> found = contradictions();
  CHECK(found.size() == 12);
  const auto said = [&found](const char* what) {
    return std::any_of(found.begin(), found.end(),
                       [what](const Contradiction& c) { return c.text.find(what) != std::string::npos; });
  };
  CHECK(said("8.44, 4.96 and 7.83"));
  CHECK(said("0.0331, 0.0195 and 0.0307"));
  CHECK(said("0.028, 0.015 and 0.027"));
  CHECK(said("301, 331 and 290"));
  CHECK(said("25.8 times the throughput, at speedups of 5.0 to 8.4"));
  CHECK(said("3.1, 5.2 and 3.3 times the operations"));
  CHECK(said("m = 255"));
  CHECK(said("T2300"));
  CHECK_FALSE(said("{"));
}

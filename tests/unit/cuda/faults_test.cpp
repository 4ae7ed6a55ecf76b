// Tests the CUDA backend while memory is short, its device fails, or batches are not awaited: the meshes must be the
// same.

#include <atomic>
#include <random>

#include "catch.h"
#include "cuda_machine.h"
#include "rounds.h"
#include "unit/backend/spheres.h"

using namespace sgm;

namespace {

std::vector<ChunkJob> manyOps(uint32_t count) {
  std::vector<ChunkJob> jobs;
  for (uint32_t i = 0; i < count; ++i) jobs.push_back(randomJob(20'260'101 + i, static_cast<int>(i % 4)).job);
  return jobs;
}

}  // namespace

TEST_CASE("a chunk that finds no room in its batch is meshed by the CPU, and counted", "[cuda]") {
  const std::vector<ChunkJob> jobs = spheres(31, 24);
  for (const bool few_vertices : {true, false}) {
    cuda::Room room;
    (few_vertices ? room.vertices : room.indices) = few_vertices ? 1200 : 7200;
    const CudaMachine machine(CudaMachine::shuffled(), room);
    CAPTURE(few_vertices);
    checkSame(meshesOf(*machine.scalar, jobs), meshesOf(*machine.cuda, jobs));
    CHECK(machine.cuda->counters().on_cpu > 0);
    CHECK(machine.cuda->counters().on_cpu < jobs.size());
  }
}

TEST_CASE("programs that pruning has no room for are taken whole", "[cuda]") {
  const std::vector<ChunkJob> jobs = manyOps(24);
  for (const uint64_t bytes : {uint64_t{0}, uint64_t{1000}, uint64_t{100'000}}) {
    cuda::Room room;
    room.pool_bytes = bytes;
    const CudaMachine machine(CudaMachine::shuffled(), room);
    CAPTURE(bytes);
    checkSame(meshesOf(*machine.scalar, jobs), meshesOf(*machine.cuda, jobs));
    CHECK(machine.cuda->counters().on_cpu == 0);
  }
}

TEST_CASE("a batch that takes more scratch than there may be is cut", "[cuda]") {
  const std::vector<ChunkJob> jobs = manyOps(16);
  cuda::Room room;
  room.scratch_bytes = uint64_t{2} << 20;
  const CudaMachine machine(CudaMachine::shuffled(), room);
  checkSame(meshesOf(*machine.scalar, jobs), meshesOf(*machine.cuda, jobs));
  CHECK(machine.cuda->counters().batches > 3);
  CHECK(machine.cuda->counters().on_cpu == 0);
}

TEST_CASE("any order of blocks and threads gives the same bytes", "[cuda]") {
  const std::vector<ChunkJob> jobs = manyOps(10);
  std::vector<ChunkMesh> expected;
  for (uint32_t seed = 0; seed < rounds(6); ++seed) {
    cuda::HostDeviceOptions host;
    if (seed > 0) host.shuffled = seed;
    const CudaMachine machine(host);
    if (expected.empty()) expected = meshesOf(*machine.scalar, jobs);
    CAPTURE(seed);
    checkSame(expected, meshesOf(*machine.cuda, jobs));
  }
}

TEST_CASE("chunks after which the caller wants no more are not meshed", "[cuda]") {
  const CudaMachine machine;
  std::vector<ChunkJob> jobs = spheres(32, 12);
  std::atomic<uint32_t> told{0};
  Result<std::unique_ptr<ChunkBatch>> batch = machine.cuda->submit(jobs, [&] { return ++told < 3; });
  REQUIRE(batch);
  (*batch)->wait();
  const auto meshes = (*batch)->take();
  REQUIRE(!meshes);
  CHECK(meshes.error().code == Code::cancelled);
  CHECK(told == 3);
  // The batch is destroyed in the middle of its work.
  batch = machine.cuda->submit(jobs);
  batch = machine.cuda->submit(jobs);
  (*batch)->wait();
  checkSame(meshesOf(*machine.scalar, jobs), *(*batch)->take());
}

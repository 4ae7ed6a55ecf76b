// Tests that a device's backend gives the same bytes as the scalar CPU backend: for every operation, random programs,
// and the sample grammars. The file is compiled for each kind of device; SGM_TEST_MACHINE names the header that defines
// TestedMachine.
//
// All test cases share one backend: Vulkan makes pipelines for the instructions that it has met, which takes seconds,
// so the first batch contains all instructions.

#include <algorithm>
#include <iostream>

#include "catch.h"
#include "chunk/mesh_chunks.h"
#include "compare_meshes.h"
#include "mesh_jobs.h"
#include "rounds.h"
#include "unit/world/world_support.h"

#include SGM_TEST_MACHINE

using namespace sgm;

namespace {

uint32_t seedOfAll() {
  const char* text = std::getenv("SGM_TEST_SEED");
  return text ? static_cast<uint32_t>(std::strtoul(text, nullptr, 10)) : 20'260'101u;
}

std::vector<ChunkJob> jobsOf(const std::vector<NamedJob>& named) {
  std::vector<ChunkJob> jobs;
  for (const NamedJob& one : named) jobs.push_back(one.job);
  return jobs;
}

TestedMachine& machine() {
  static TestedMachine one;
  return one;
}

/// Returns true if there is a device to be tested. The first call meshes one job for every instruction, so that all
/// pipelines exist afterwards.
bool ready() {
  static const bool made = [] {
    if (!machine()) return false;
    std::cout << "comparing " << machine().device().capabilities().device << " with scalar, seed " << seedOfAll()
              << std::endl;
    (void)meshesOf(machine().device(), jobsOf(jobsOfEveryOp(seedOfAll(), 1)));
    return true;
  }();
  return made;
}

struct Seen {
  size_t triangles = 0, in_seams = 0;
};

/// Meshes the jobs with both backends, in batches of `batch` jobs, and compares the meshes.
Seen compare(const std::vector<NamedJob>& named, size_t batch = 64) {
  Seen seen;
  for (size_t first = 0; first < named.size(); first += batch) {
    const auto from = named.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<NamedJob> some(from, from + static_cast<std::ptrdiff_t>(std::min(batch, named.size() - first)));
    const std::vector<ChunkMesh> expected = meshesOf(*machine().scalar, jobsOf(some));
    const std::vector<ChunkMesh> found = meshesOf(machine().device(), jobsOf(some));
    for (size_t i = 0; i < some.size(); ++i) {
      INFO(some[i].name);
      CHECK(differenceOf(expected[i], found[i]) == "");
      seen.triangles += expected[i].body.indices.size() / 3;
      for (const MeshPart& seam : expected[i].seams) seen.in_seams += seam.indices.size() / 3;
    }
  }
  return seen;
}

/// Counts how many chunks the CPU has meshed in the device's place since this object was constructed.
struct OnDevice {
  BackendCounters before = machine().device().counters();
  uint64_t byCpu() const { return machine().device().counters().on_cpu - before.on_cpu; }
};

}  // namespace

TEST_CASE("every op gives the scalar backend's bytes on the device, at the origin and at the world's ends") {
  if (!ready()) return;
  const OnDevice device;
  const std::vector<NamedJob> jobs = jobsOfEveryOp(seedOfAll(), rounds(3));
  const Seen seen = compare(jobs);
  CHECK(seen.triangles > 300 * jobs.size());
  CHECK(device.byCpu() == 0);
  CHECK(machine().silent());
}

TEST_CASE("random programs give the scalar backend's bytes on the device, seams, signs and all") {
  if (!ready()) return;
  const OnDevice device;
  std::vector<NamedJob> jobs;
  for (uint32_t i = 0; i < rounds(120); ++i) jobs.push_back(randomJob(seedOfAll() + i, static_cast<int>(i % 5)));
  const Seen seen = compare(jobs);
  CAPTURE(seen.triangles, seen.in_seams);
  CHECK(seen.triangles > 300 * jobs.size());
  CHECK(seen.in_seams > 20 * jobs.size());
  CHECK(device.byCpu() < jobs.size() / 4);
  CHECK(machine().silent());
}

TEST_CASE("sums alone are those over the meshes, in batches of their own and beside meshes") {
  if (!ready()) return;
  const OnDevice device;
  std::vector<NamedJob> jobs = jobsOfEveryOp(seedOfAll(), 1);
  for (uint32_t i = 0; i < rounds(60); ++i) jobs.push_back(randomJob(seedOfAll() + 9000 + i, static_cast<int>(i % 5)));
  for (const size_t every : {size_t{1}, size_t{3}}) {
    std::vector<NamedJob> asked = jobs;
    for (size_t i = 0; i < asked.size(); i += every) asked[i].job.sums_only = true;
    const std::vector<ChunkMesh> meshes = meshesOf(*machine().scalar, jobsOf(jobs));
    const std::vector<ChunkMesh> expected = meshesOf(*machine().scalar, jobsOf(asked));
    const std::vector<ChunkMesh> found = meshesOf(machine().device(), jobsOf(asked));
    size_t triangles = 0;
    for (size_t i = 0; i < jobs.size(); ++i) {
      INFO(asked[i].name << ", sums of every " << every);
      CHECK(differenceOf(expected[i], found[i]) == "");
      if (!asked[i].job.sums_only) continue;
      CHECK(found[i].body.vertices.empty());
      CHECK(found[i].sums[0] == sumsOf(meshes[i].body.vertices, meshes[i].body.indices));
      for (size_t face = 0; face < meshes[i].seams.size(); ++face) {
        CHECK(found[i].seams[face].vertices.empty());
        CHECK(found[i].sums[1 + face] == sumsOf(meshes[i].seams[face].vertices, meshes[i].seams[face].indices));
      }
      triangles += found[i].sums[0].triangles;
    }
    CHECK(triangles > 300 * jobs.size() / every);
  }
  CHECK(device.byCpu() < jobs.size() / 4);
  CHECK(machine().silent());
}

TEST_CASE("a prism of a thousand corners is meshed by the device, or by the CPU and counted") {
  if (!ready()) return;
  const OnDevice device;
  std::vector<Int3> corners;  // a square outline with many vertices along its sides
  constexpr int32_t kSide = 250, kStep = 40;
  for (int32_t side = 0; side < 4; ++side) {
    for (int32_t i = 0; i < kSide; ++i) {
      const int32_t along = (2 * i - kSide) * kStep / 2, across = kSide * kStep / 2 + i % 2;
      const Int3 turned[] = {{along, 0, across}, {across, 0, -along}, {-along, 0, -across}, {-across, 0, along}};
      corners.push_back(turned[side]);
    }
  }
  ProgramBuilder builder(512, false, 0);
  REQUIRE(builder.group(builder.prism({}, 2000.0f, corners, 0), IntBox::everything(), 0, false));
  NamedJob one;
  one.job.grid = gridAround({0, 0, 0}, 512);
  one.job.field = shared(builder.finish());
  one.name = "a prism of 1,000 corners";
  const Seen seen = compare({one});
  CHECK(seen.triangles > 0);
  CHECK(device.byCpu() == (TestedMachine::kAnyPrism ? 0 : 1));
}

TEST_CASE(
    "sums of morphed shapes give the scalar backend's bytes, whatever else reads the shapes, the weights, the time") {
  if (!ready()) return;
  const OnDevice device;
  std::mt19937 random(seedOfAll());
  const auto between = [&random](float low, float high) {
    return low + (high - low) * static_cast<float>(random() % 1024) / 1023.0f;
  };
  static constexpr float kTimes[] = {-0.25f, 0, 1e-6f, 0.25f, 0.5f, 1, 1.5f};
  constexpr uint32_t kReaders = 5;
  std::vector<NamedJob> jobs;
  for (const float time : kTimes) {
    for (uint32_t reader = 0; reader < kReaders; ++reader) {
      ProgramBuilder b(512, false, makeLabel(1, 0));
      KernelSum sum(b);
      Value t = b.constant(time), kernel, shape;
      for (uint16_t i = 0; i < 12; ++i) {
        const Int3 at{static_cast<int32_t>(between(-5000, 5000)), static_cast<int32_t>(between(-5000, 5000)),
                      static_cast<int32_t>(between(-5000, 5000))};
        Frame frame;
        frame.origin = at;
        const float r = between(1000, 2500);
        const Value ball = b.sphere(at, r, makeLabel(2, i));
        shape = b.ternary(Op::morph, ball, b.superquadric(frame, r, 0.5f * r, r, 4, makeLabel(3, i)), t);
        kernel = b.kernelWeight(shape, 0.6f * r);
        sum.add(kernel);
      }
      // The device may merge a kernel's value into the sum only if no other instruction reads it. With readers 1 and 2,
      // another instruction does.
      if (reader == 1) sum.add(kernel);
      if (reader == 2) sum.add(b.binary(Op::multiply, kernel, kernel));
      if (reader == 3) sum.add(b.binary(Op::maximum, t, b.constant(0.01f)));
      Value root = sum.end(0.2263f, 1500);
      if (reader == 4) root = b.binary(Op::cut, root, b.ternary(Op::mix, shape, root, t));
      REQUIRE(b.group(root, IntBox::everything(), 0, false));
      NamedJob& one = jobs.emplace_back();
      one.job.grid = gridAround({0, 0, 0}, 512);
      one.job.field = one.job.coarse = shared(b.finish());
      one.job.seams = 63;
      one.name = "time " + std::to_string(time) + ", reader " + std::to_string(reader);
    }
  }
  const Seen seen = compare(jobs);
  CHECK(seen.triangles > 300 * jobs.size());
  CHECK(device.byCpu() == 0);
  CHECK(machine().silent());
}

TEST_CASE("batches of any size give the same bytes, programs of nothing among them") {
  if (!ready()) return;
  std::vector<NamedJob> jobs;
  for (uint32_t i = 0; i < 200; ++i) {
    NamedJob& one = jobs.emplace_back(randomJob(seedOfAll() + 5000 + i % 20, 0));
    if (i % 4 != 0) continue;
    // Chunks that are entirely solid or void, some with seams to chunks that are not.
    one.job.field = shared(ProgramBuilder(512, i % 8 == 0, makeLabel(3, 1)).finish());
    one.job.seams = static_cast<uint8_t>(one.job.coarse ? one.job.seams : 0);
    one.job.signs = true;
    one.name += ", nothing in it";
  }
  CHECK(meshesOf(machine().device(), {}).empty());
  const std::vector<NamedJob> few(jobs.begin(), jobs.begin() + 5);
  CHECK(compare(few, 1).triangles > 0);
  CHECK(compare(jobs, 200).triangles > 0);
  CHECK(machine().silent());
}

TEST_CASE("the sample grammars give the scalar backend's bytes on the device") {
  if (!ready()) return;
  struct Place {
    const char* grammar;
    int32_t cell;
    Int3 from, to;  ///< corners of the meshed region, in metres
  };
  static constexpr Place kPlaces[] = {{"arches.sgm", 256, {-8, 0, -8}, {8, 8, 8}},
                                      {"building.sgm", 256, {-16, -2, -16}, {16, 30, 16}},
                                      {"cave.sgm", 256, {88, 72, 72}, {136, 120, 120}},
                                      {"choice.sgm", 256, {0, 0, 0}, {32, 8, 32}},
                                      {"cloud.sgm", 4096, {0, 800, 0}, {1050, 1800, 1050}},
                                      {"combine.sgm", 256, {-12, -12, -12}, {12, 12, 12}},
                                      {"morph.sgm", 256, {-12, -12, -12}, {12, 12, 12}},
                                      {"passage.sgm", 512, {0, -8, -8}, {64, 8, 8}},
                                      {"primitives.sgm", 256, {-12, -12, -12}, {12, 12, 12}},
                                      {"sphere.sgm", 256, {-4, -4, -4}, {4, 4, 4}},
                                      {"terrain.sgm", 1024, {-40, -10, -40}, {40, 20, 40}},
                                      {"tree.sgm", 256, {-6, 0, -6}, {6, 10, 6}}};
  for (const Place& place : kPlaces) {
    CAPTURE(place.grammar);
    const WorldField world(settingsOf(yardstick(place.grammar), place.cell, 3), std::pmr::get_default_resource());
    std::mt19937 random(seedOfAll());
    std::vector<ChunkRequest> requests;
    for (uint32_t i = 0; i < rounds(24); ++i) {
      ChunkRequest& request = requests.emplace_back();
      request.key.level = static_cast<int>(random() % 3);
      const int64_t edge = int64_t{kChunkCells} * place.cell << request.key.level;
      for (int axis = 0; axis < 3; ++axis) {
        const int64_t low = int64_t{place.from[axis]} * kUnitsPerMetre, high = int64_t{place.to[axis]} * kUnitsPerMetre;
        const int64_t at = low + static_cast<int64_t>(random() % static_cast<uint64_t>(high - low));
        request.key.at[axis] = static_cast<int32_t>(floorDiv(at, edge));
      }
      request.seams = static_cast<uint8_t>(random() % 2 ? random() % 64 : 0);
      request.coarser = neighboursAcross(request.seams);
      request.signs = random() % 2 == 0;
      request.outermost = random() % 4 == 0;
    }
    const auto by = [&](Backend& backend) {
      auto chunks = meshChunks(world, backend, *machine().jobs, requests);
      INFO((chunks ? std::string() : chunks.error().message));
      REQUIRE(chunks);
      return std::move(*chunks);
    };
    const auto expected = by(*machine().scalar);
    const OnDevice device;
    const auto found = by(machine().device());
    // Most chunks must be meshed on the device, since no sample grammar exceeds the shader's limits.
    CHECK(device.byCpu() < requests.size() / 2);
    size_t triangles = 0;
    for (size_t i = 0; i < requests.size(); ++i) {
      const ChunkKey& key = requests[i].key;
      CAPTURE(key.level, key.at.x, key.at.y, key.at.z, int{requests[i].seams});
      CHECK(differenceOf(expected[i].mesh, found[i].mesh) == "");
      triangles += expected[i].mesh.body.indices.size() / 3;
    }
    CHECK(triangles > 20 * requests.size());
  }
  CHECK(machine().silent());
}

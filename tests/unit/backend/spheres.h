#pragma once
// Batches of jobs with spheres, and comparisons of their meshes.

#include <chrono>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "backend/backend.h"
#include "catch.h"
#include "compare_meshes.h"
#include "mesh_jobs.h"

namespace sgm {

/// Jobs with spheres, with seams to other spheres. They use few kinds of instructions, so pipelines are made quickly.
inline std::vector<ChunkJob> spheres(uint32_t seed, uint32_t count) {
  std::mt19937 random(seed);
  std::vector<ChunkJob> jobs;
  for (uint32_t i = 0; i < count; ++i) {
    const auto program = [&] {
      ProgramBuilder b(512, false, makeLabel(1, 0));
      const auto radius = static_cast<float>(1000 + random() % 4000);
      (void)b.group(b.sphere({static_cast<int32_t>(random() % 2000), 0, 0}, radius, makeLabel(2, 1)),
                    IntBox::everything(), 0, false);
      return shared(b.finish());
    };
    ChunkJob& job = jobs.emplace_back();
    job.grid = gridAround({}, 256);
    job.field = program();
    job.coarse = program();
    job.seams = static_cast<uint8_t>(random() % 64);
    job.coarser = neighboursAcross(job.seams);
    job.signs = random() % 2 == 0;
  }
  return jobs;
}

inline std::vector<ChunkMesh> polled(Backend& backend, const std::vector<ChunkJob>& jobs) {
  Result<std::unique_ptr<ChunkBatch>> batch = backend.submit(jobs);
  REQUIRE(batch);
  while (!(*batch)->poll()) std::this_thread::sleep_for(std::chrono::microseconds(200));
  Result<std::vector<ChunkMesh>> meshes = (*batch)->take();
  REQUIRE(meshes);
  return std::move(*meshes);
}

inline void checkSame(const std::vector<ChunkMesh>& expected, const std::vector<ChunkMesh>& found) {
  REQUIRE(expected.size() == found.size());
  for (size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i);
    CHECK(differenceOf(expected[i], found[i]) == "");
  }
}

}  // namespace sgm

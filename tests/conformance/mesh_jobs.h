#pragma once
// Jobs on which backends are compared: with every operation and with random programs, near the origin and near the
// world's ends.

#include <memory>
#include <string>
#include <vector>

#include "backend/backend.h"
#include "base/fixed.h"
#include "catch.h"
#include "field/builder.h"
#include "random_programs.h"

namespace sgm {

/// A job, and its name in messages about differences.
struct NamedJob {
  ChunkJob job;
  std::string name;
};

inline std::shared_ptr<const FieldProgram> shared(FieldProgram program) {
  return std::make_shared<FieldProgram>(std::move(program));
}

/// Returns the grid of a chunk with this cell size and `place` in its middle, aligned to the grid of the next coarser
/// level.
inline ChunkGrid gridAround(Int3 place, int32_t cell) {
  ChunkGrid grid{{}, cell, 0};
  const int64_t step = 2 * int64_t{cell};
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t low = floorDiv(int64_t{place[axis]} - kChunkCells * int64_t{cell} / 2, step) * step;
    grid.origin[axis] = static_cast<int32_t>(low);
  }
  return grid;
}

/// Makes a program with a layer that adds and cuts, and a smooth layer above it; programs of a single operation have
/// neither.
inline FieldProgram layered(Int3 centre) {
  constexpr float kMetre = kUnitsPerMetre;
  ProgramBuilder b(512, false, makeLabel(1, 0));
  const auto add = [&](int32_t x, float radius, uint32_t layer, bool cut, float smooth) {
    const Int3 at{centre.x + x * kUnitsPerMetre, centre.y, centre.z};
    (void)b.group(b.sphere(at, radius * kMetre, makeLabel(2, static_cast<uint16_t>(layer))), IntBox::everything(),
                  layer, cut, smooth);
  };
  add(0, 2, 0, false, 0);
  add(1, 1, 0, true, 0);
  add(-1, 2, 1, false, kMetre);
  return b.finish();
}

/// Makes `often` jobs for every operation. Each job is one chunk; places and cell sizes differ from job to job.
inline std::vector<NamedJob> jobsOfEveryOp(uint32_t seed, uint32_t often) {
  std::vector<NamedJob> jobs;
  for (uint32_t round = 0; round < often; ++round) {
    for (uint32_t o = 0; o < static_cast<uint32_t>(Op::count); ++o) {
      std::mt19937 random(seed + round);
      const Int3 centre = kTestCentres[(round + o) % 3];
      const int32_t cell = 256 << (round + o / 3) % 5;
      NamedJob& named = jobs.emplace_back();
      named.job.grid = gridAround(centre, cell);
      named.job.field = shared(programOf(static_cast<Op>(o), random, centre));
      named.name = std::string("op ") + opName(static_cast<Op>(o)) + ", seed " + std::to_string(seed + round) +
                   ", cell " + std::to_string(cell) + ", centre " + std::to_string((round + o) % 3);
    }
    const Int3 centre = kTestCentres[round % 3];
    NamedJob& named = jobs.emplace_back();
    named.job.grid = gridAround(centre, 256);
    named.job.field = shared(layered(centre));
    named.name = "layers, centre " + std::to_string(round % 3);
  }
  return jobs;
}

/// Makes a job with a random program, with seams on random faces to a second random program, and with random request
/// flags.
inline NamedJob randomJob(uint32_t seed, int depth) {
  std::mt19937 random(seed);
  RandomProgramOptions options;
  options.centre = kTestCentres[seed % 3];
  options.depth = depth;
  options.groups = 1 + static_cast<int>(random() % 4);
  options.odd = {seed % 5 == 1, seed % 5 == 2};
  options.smooth_groups = static_cast<int>(random() % 3);
  NamedJob named;
  ChunkJob& job = named.job;
  job.grid = gridAround(options.centre, 256 << random() % 5);
  job.field = shared(randomProgram(random, options));
  job.seams = static_cast<uint8_t>(random() % 4 == 0 ? 0 : random() % 64);
  job.coarser = neighboursAcross(job.seams) | (random() % (Neighbourhood{1} << 27) & ~neighbourBit(0, 0, 0));
  job.signs = random() % 2 == 0;
  job.body = random() % 4 != 0;
  if (job.seams != 0) job.coarse = shared(randomProgram(random, options));
  named.name = "random program, seed " + std::to_string(seed) + ", depth " + std::to_string(depth) + ", " +
               std::to_string(job.field->view().instrs.size()) + " instructions";
  return named;
}

/// Submits the jobs as one batch, and waits for their meshes.
inline std::vector<ChunkMesh> meshesOf(Backend& backend, const std::vector<ChunkJob>& jobs) {
  Result<std::unique_ptr<ChunkBatch>> batch = backend.submit(jobs);
  REQUIRE(batch);
  (*batch)->wait();
  Result<std::vector<ChunkMesh>> meshes = (*batch)->take();
  INFO((meshes ? std::string() : meshes.error().message));
  REQUIRE(meshes);
  REQUIRE(meshes->size() == jobs.size());
  return std::move(*meshes);
}

}  // namespace sgm

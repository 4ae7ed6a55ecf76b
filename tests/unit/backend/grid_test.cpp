// The grid's passes of every instruction set against the scalar ones, bit by bit.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "backend/cpu/grid/grid_kernels.h"
#include "catch.h"
#include "mesh/body.h"
#include "rounds.h"

using namespace sgm;

namespace {

struct Meshed {
  std::vector<uint64_t> signs;
  std::vector<float> positions, normals;
  std::vector<uint32_t> indices;
  bool finite = true;
  bool operator==(const Meshed& other) const {
    const auto same = [](const auto& a, const auto& b) {
      return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
    };
    return finite == other.finite && signs == other.signs && same(positions, other.positions) &&
           same(normals, other.normals) && indices == other.indices;
  }
};

Meshed meshed(const GridKernels& kernels, GridJob job, size_t slabs, bool normals) {
  Meshed result;
  job.words = (job.size[0] + 63) / 64;
  result.signs.resize(job.words * job.size[1] * job.size[2]);
  job.signs = result.signs.data();
  const size_t planes = job.size[2];
  for (size_t z = 0; z < planes; ++z)
    for (size_t y = 0; y < job.size[1]; ++y) result.finite = kernels.signs(job, y, z) && result.finite;
  if (!result.finite) return result;
  std::vector<uint64_t> vertices(planes + 1), triangles(planes + 1);
  for (size_t z = 0; z < planes; ++z) {
    const GridCounts counts = kernels.count(job, z);
    vertices[z + 1] = vertices[z] + counts.vertices;
    triangles[z + 1] = triangles[z] + counts.triangles;
  }
  result.positions.resize(vertices.back() * 3);
  if (normals) result.normals.resize(vertices.back() * 3);
  result.indices.resize(triangles.back() * 3);
  job.positions = result.positions.data();
  job.normals = normals ? result.normals.data() : nullptr;
  job.indices = result.indices.data();
  std::vector<uint32_t> numbers(2 * job.size[0] * job.size[1]), edges(6 * gridEdgeRoom(job.size[0]));
  std::vector<uint8_t> crossings(vertices.back() + 1);
  const size_t thick = (planes + slabs - 1) / slabs;
  for (size_t first = 0; first < planes; first += thick)
    kernels.mesh(job, {first, std::min(planes, first + thick), vertices.data(), triangles.data()},
                 {numbers.data(), edges.data(), crossings.data()});
  return result;
}

/// Smooth, noise of many sizes, or both: values far beyond the range of Q, and some that are nearly 0.
std::vector<float> someValues(std::mt19937& random, size_t count) {
  std::vector<float> values(count);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  const int kind = static_cast<int>(random() % 3);
  for (size_t i = 0; i < count; ++i) {
    const float smooth = std::sin(static_cast<float>(i % 97) * 0.1f) + std::sin(static_cast<float>(i) * 0.003f);
    const float noise = unit(random) * std::exp2(static_cast<float>(random() % 60) - 40.0f);
    values[i] = kind == 0 ? smooth : kind == 1 ? noise : smooth + 0.2f * unit(random);
  }
  return values;
}

/// A chunk of the same values, as its own polygonizer takes them.
ChunkSamples chunkOf(const GridJob& job) {
  ChunkSamples samples;
  for (size_t z = 0; z < kChunkSamples; ++z) {
    for (size_t y = 0; y < kChunkSamples; ++y) {
      const size_t row = y + z * kChunkSamples;
      for (size_t x = 0; x < kChunkSamples; ++x) {
        const float scaled = std::clamp(job.row(y, z)[x] * job.scale, -float{kMaxQ}, float{kMaxQ});
        const auto q = static_cast<int32_t>(std::floor(scaled + 0.5f));
        samples.q[row * kChunkSamples + x] = q;
        samples.signs[row] |= uint64_t{q < 0} << x;
      }
    }
  }
  return samples;
}

}  // namespace

TEST_CASE("a grid of a chunk's size is meshed as a chunk is") {
  const uint32_t seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(12); ++round) {
    CAPTURE(round);
    GridJob job;
    job.size = {kChunkSamples, kChunkSamples, kChunkSamples};
    job.stride_y = kChunkSamples;
    job.stride_z = size_t{kChunkSamples} * kChunkSamples;
    const std::vector<float> values = someValues(random, job.stride_z * kChunkSamples);
    job.values = values.data();
    job.scale = 1024;
    job.step = 1.0 / kSubcell;
    MeshPart part{std::pmr::get_default_resource()};
    polygonizeBody(chunkOf(job), ChunkGrid{}, part);
    for (const char* name : {"scalar", "sse4.2", "avx2", "avx512"}) {
      CAPTURE(name);
      const GridKernels* kernels = findGridKernels(name);
      if (kernels == nullptr) continue;
      const Meshed mesh = meshed(*kernels, job, 1 + random() % 5, false);
      CHECK(mesh.indices == std::vector<uint32_t>(part.indices.begin(), part.indices.end()));
      REQUIRE(mesh.positions.size() == part.vertices.size() * 3);
      bool same = true;
      for (size_t i = 0; i < part.vertices.size(); ++i) {
        const Vertex& v = part.vertices[i];
        const float* at = &mesh.positions[3 * i];
        same = same && at[0] * kSubcell == v.x && at[1] * kSubcell == v.y && at[2] * kSubcell == v.z;
      }
      CHECK(same);
    }
  }
}

TEST_CASE("every instruction set meshes a grid as the scalar one does") {
  const uint32_t seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(40); ++round) {
    CAPTURE(round);
    GridJob job;
    for (size_t& size : job.size) size = 2 + random() % 20;
    job.size[0] = 2 + random() % (round % 2 == 0 ? 20 : 200);
    job.stride_y = job.size[0] + random() % 4;
    job.stride_z = job.stride_y * job.size[1] + random() % 9;
    std::vector<float> values = someValues(random, job.stride_z * job.size[2]);
    if (round % 10 == 9) values[random() % job.size[0]] = round % 20 == 9 ? INFINITY : NAN;
    job.values = values.data();
    job.scale = round % 3 == 0 ? 1024.0f : 900.0f;
    job.step = round % 3 == 0 ? 1.0 / 256 : 0.37 / 256;
    const bool normals = round % 4 != 0;
    const Meshed expected = meshed(scalarGridKernels(), job, 1, normals);
    CHECK(expected.finite == (round % 10 != 9));
    for (const char* name : {"scalar", "sse4.2", "avx2", "avx512"}) {
      CAPTURE(name);
      if (const GridKernels* kernels = findGridKernels(name))
        CHECK(meshed(*kernels, job, 1 + random() % 5, normals) == expected);
    }
  }
}

// Single-thread speed of polygonizeBody, seams, hashing, welding and checking, in 32^3 chunks of fixed fields. Prints
// CSV. usage: mesh_bench [repetitions]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <vector>

#include "mesh/body.h"
#include "mesh/check.h"
#include "mesh/hash.h"
#include "mesh/seam.h"
#include "mesh/weld.h"

namespace {

using namespace sgm;

constexpr int kChunksAlong = 8;
constexpr double kSide = kChunksAlong * kChunkCells;

struct Scene {
  const char* name;
  std::function<double(double, double, double)> field;  // in cells
};

ChunkSamples sample(const Scene& scene, Int3 chunk) {
  ChunkSamples samples;
  for (size_t z = 0; z < kChunkSamples; ++z) {
    for (size_t y = 0; y < kChunkSamples; ++y) {
      uint64_t row = 0;
      for (size_t x = 0; x < kChunkSamples; ++x) {
        const double f =
            scene.field(chunk.x * kChunkCells + static_cast<double>(x), chunk.y * kChunkCells + static_cast<double>(y),
                        chunk.z * kChunkCells + static_cast<double>(z));
        const auto q = static_cast<int32_t>(std::floor(std::clamp(f, -4096.0, 4096.0) * 1024 + 0.5));
        samples.q[x + kChunkSamples * (y + kChunkSamples * z)] = q;
        row |= uint64_t{q < 0} << x;
      }
      samples.signs[y + kChunkSamples * z] = row;
    }
  }
  return samples;
}

CoarseFace coarseFaceOf(const ChunkSamples& samples) {
  CoarseFace coarse;
  for (size_t b = 0; b < kCoarseSamples; ++b) {
    for (size_t a = 0; a < kCoarseSamples; ++a) {
      const int32_t q = samples.q[kChunkCells + kChunkSamples * (2 * a + kChunkSamples * 2 * b)];
      coarse.q[a + kCoarseSamples * b] = q;
      coarse.signs[b] |= static_cast<uint32_t>(q < 0) << a;
    }
  }
  return coarse;
}

/// The median time of a call, in seconds of this process's processor time: other work on the machine disturbs it
/// little.
double medianSeconds(int repetitions, const std::function<void()>& run) {
  std::vector<double> times;
  for (int i = 0; i < repetitions; ++i) {
    const std::clock_t start = std::clock();
    run();
    times.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void measure(const Scene& scene, int repetitions) {
  std::vector<ChunkSamples> chunks;
  std::vector<ChunkGrid> grids;
  std::vector<MeshPart> parts, seams;
  for (int z = 0; z < kChunksAlong; ++z) {
    for (int y = 0; y < kChunksAlong; ++y) {
      for (int x = 0; x < kChunksAlong; ++x) {
        ChunkSamples samples = sample(scene, {x, y, z});
        const auto solid = [](uint64_t row) { return row == (uint64_t{1} << kChunkSamples) - 1; };
        const bool empty =
            std::all_of(samples.signs.begin(), samples.signs.end(), [](uint64_t row) { return row == 0; });
        if (empty || std::all_of(samples.signs.begin(), samples.signs.end(), solid)) continue;
        chunks.push_back(std::move(samples));
        grids.push_back({{x * kChunkCells, y * kChunkCells, z * kChunkCells}, 1, 0});
      }
    }
  }
  parts.resize(chunks.size());
  seams.resize(chunks.size());
  std::vector<CoarseFace> coarse;
  for (const ChunkSamples& samples : chunks) coarse.push_back(coarseFaceOf(samples));

  const auto all = [&](auto&& each) {
    return [&, each] {
      for (size_t i = 0; i < chunks.size(); ++i) each(i);
    };
  };
  const double body = medianSeconds(repetitions, all([&](size_t i) { polygonizeBody(chunks[i], grids[i], parts[i]); }));
  const double hash = medianSeconds(repetitions, all([&](size_t i) { hashPart(parts[i]); }));
  const double seam =
      medianSeconds(repetitions, all([&](size_t i) {
                      polygonizeSeam(Face::x_hi, chunks[i], coarse[i], grids[i], neighbourBit(Face::x_hi), seams[i]);
                    }));
  std::vector<PlacedPart> placed;
  for (size_t i = 0; i < parts.size(); ++i) placed.push_back({&parts[i], grids[i], 0});
  size_t vertices = 0, triangles = 0, seam_triangles = 0;
  for (const MeshPart& p : parts) vertices += p.vertices.size(), triangles += p.indices.size() / 3;
  for (const MeshPart& p : seams) seam_triangles += p.indices.size() / 3;
  WorldMesh world;
  const double weld_time = medianSeconds(3, [&] { world = *weld(placed, {}); });
  MeshReport report;
  const double check = medianSeconds(3, [&] { report = checkTriangles(world.indices, world.positions.size()); });
  const auto n = static_cast<double>(chunks.size());
  std::printf("%s,%zu,%zu,%zu,%.1f,%.1f,%.1f,%.1f,%zu,%.1f,%.1f,%s\n", scene.name, chunks.size(), vertices, triangles,
              body / n * 1e6, static_cast<double>(triangles) / body * 1e-6, hash / n * 1e6, seam / n * 1e6,
              seam_triangles, weld_time * 1e3, check * 1e3, report.manifold() ? "manifold" : "not manifold");
}

}  // namespace

int main(int argc, char** argv) {
  const int repetitions = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  const double c = kSide / 2;
  const Scene scenes[] = {
      {"sphere",
       [c](double x, double y, double z) {
         return std::sqrt((x - c) * (x - c) + (y - c) * (y - c) + (z - c) * (z - c)) - 0.39 * kSide;
       }},
      {"gyroid",
       [](double x, double y, double z) {
         const double k = 0.2;
         return 3 * (std::sin(k * x) * std::cos(k * y) + std::sin(k * y) * std::cos(k * z) +
                     std::sin(k * z) * std::cos(k * x));
       }},
      {"rough",
       [c](double x, double y, double z) {
         const double r = std::sqrt((x - c) * (x - c) + (y - c) * (y - c) + (z - c) * (z - c)) - 0.39 * kSide;
         return r + 6 * std::sin(0.31 * x) * std::sin(0.27 * y) * std::sin(0.29 * z) +
                1.5 * std::sin(1.3 * x + 0.4 * y) * std::sin(1.1 * z);
       }},
  };
  std::printf(
      "scene,chunks,vertices,triangles,body_us_per_chunk,body_mtri_per_s,hash_us_per_chunk,seam_us,seam_triangles,weld_"
      "ms,check_ms,check\n");
  for (const Scene& scene : scenes) measure(scene, repetitions);
  return 0;
}

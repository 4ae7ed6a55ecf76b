// Tests meshing of chunks from hand-built and random programs: pruning against brute force, all instruction sets,
// borders of chunks, octrees.

#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "backend/backend.h"
#include "backend/cpu/instruction_sets.h"
#include "backend/cpu/mesh_chunk.h"
#include "backend/open/open_backend.h"
#include "catch.h"
#include "field/builder.h"
#include "mesh/body.h"
#include "mesh/check.h"
#include "mesh/seam.h"
#include "mesh/vertex.h"
#include "mesh/weld.h"
#include "random_programs.h"
#include "rounds.h"

using namespace sgm;

namespace {

constexpr int32_t kCell = 256;
constexpr int32_t kEdge = kChunkCells * kCell;

ChunkGrid gridAt(int level, Int3 at) {
  const int32_t cell = kCell << level;
  return {{at.x * kChunkCells * cell, at.y * kChunkCells * cell, at.z * kChunkCells * cell}, cell, level};
}

// A random program of shapes around `centre`. The influence boxes of its groups are unbounded.
std::shared_ptr<const FieldProgram> programAround(uint32_t seed, Int3 centre, int32_t extent) {
  std::mt19937 random(seed);
  RandomProgramOptions options;
  options.centre = centre;
  options.extent = extent;
  options.finest_cell = kCell;
  options.depth = 3;
  options.whole_influence = true;
  return std::make_shared<FieldProgram>(randomProgram(random, options));
}

ChunkMesh meshOf(const FieldKernels& kernels, const ChunkJob& job) {
  ChunkScratch scratch(std::pmr::get_default_resource());
  ChunkMesh mesh;
  meshChunk({kernels, *findMeshKernels(kernels.name)}, job, scratch, mesh);
  return mesh;
}

bool sameBytes(const MeshPart& a, const MeshPart& b) {
  return a.indices == b.indices && a.keys == b.keys && a.hash == b.hash && a.vertices.size() == b.vertices.size() &&
         (a.vertices.empty() ||
          std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vertex)) == 0);
}

// Meshes a chunk without pruning, for comparison: evaluates the whole program for every sample and every attribute.
ChunkMesh bruteForce(const FieldProgram& field, const ChunkGrid& grid) {
  ChunkMesh mesh;
  ChunkSamples samples;
  PointSet p = gridPoints({grid.origin,
                           {grid.origin.x + kChunkCells * grid.cell, grid.origin.y + kChunkCells * grid.cell,
                            grid.origin.z + kChunkCells * grid.cell}},
                          grid.cell);
  EvalScratch scratch;
  scalarKernels().samples(field.view(), p.points(), scratch, samples.q.data());
  for (size_t i = 0; i < samples.q.size(); ++i) {
    samples.signs[i / kChunkSamples] |= uint64_t{samples.q[i] < 0} << (i % kChunkSamples);
  }
  polygonizeBody(samples, grid, mesh.body);
  PointSet v;
  for (const Vertex& vertex : mesh.body.vertices) {
    const Int3 at = vertexUnits(grid, vertex);
    v.x.push_back(at.x);
    v.y.push_back(at.y);
    v.z.push_back(at.z);
  }
  const Evaluated e = evaluate(scalarKernels(), field.view(), v.points());
  for (size_t i = 0; i < v.x.size(); ++i) {
    Vertex& vertex = mesh.body.vertices[i];
    vertex.normal_x = e.nx[i];
    vertex.normal_y = e.ny[i];
    vertex.material = static_cast<uint16_t>(e.label[i]);
    vertex.tag = static_cast<uint16_t>(e.label[i] >> 16);
  }
  hashPart(mesh.body);
  return mesh;
}

}  // namespace

TEST_CASE("a chunk meshed by pruned bricks is the chunk meshed by brute force") {
  size_t triangles = 0;
  for (uint32_t seed = 1; seed <= rounds(24); ++seed) {
    const Int3 corner = seed % 2 ? Int3{} : Int3{120'000, -120'000, 90'000};
    const ChunkGrid grid = gridAt(0, corner);
    const Int3 centre{grid.origin.x + kEdge / 2, grid.origin.y + kEdge / 2, grid.origin.z + kEdge / 2};
    ChunkJob job{grid, programAround(seed, centre, kEdge), nullptr, 0, 0};
    const ChunkMesh expected = bruteForce(*job.field, grid);
    triangles += expected.body.indices.size() / 3;
    for (const InstructionSet& set : instructionSets()) {
      if (!set.runs_here) continue;
      INFO("seed " << seed << ", " << set.kernels->name);
      CHECK(sameBytes(expected.body, meshOf(*set.kernels, job).body));
    }
  }
  CHECK(triangles > 800 * rounds(24));
}

TEST_CASE("neighbouring chunks agree in their border to the bit, each with its own pruning") {
  for (uint32_t seed = 1; seed <= 6; ++seed) {
    const auto field = programAround(seed * 31, {kEdge, kEdge / 2, kEdge / 2}, kEdge);
    std::map<VertexKey, Vertex> border;
    size_t shared = 0, different = 0;
    for (int x = 0; x < 2; ++x) {
      const ChunkGrid grid = gridAt(0, {x, 0, 0});
      const ChunkMesh mesh = meshOf(bestKernels(), {grid, field, nullptr, 0, 0});
      for (size_t i = 0; i < mesh.body.keys.size(); ++i) {
        const VertexKey key = mesh.body.keys[i];
        if (key.corner.x != kEdge || key.axis == 0) continue;
        Vertex v = mesh.body.vertices[i];
        v.x = 0;
        const auto [at, fresh] = border.emplace(key, v);
        if (fresh) continue;
        ++shared;
        different += std::memcmp(&at->second, &v, sizeof v) != 0;
      }
    }
    INFO("seed " << seed << ", " << shared << " shared");
    CHECK(different == 0);
    CHECK(shared == border.size());
  }
}

TEST_CASE("a seam's vertices have the attributes of the whole field of their level, each with its own pruning") {
  size_t own = 0, coarse = 0, different = 0;
  for (uint32_t seed = 1; seed <= rounds(10); ++seed) {
    const ChunkGrid grid = gridAt(0, {1, -1, 1});
    const Int3 centre{grid.origin.x + kEdge / 2, grid.origin.y + kEdge / 2, grid.origin.z + kEdge / 2};
    // The fields of the two levels differ much, so that seams have many vertices on the edges that join both levels.
    const ChunkJob job{grid, programAround(seed, centre, kEdge), programAround(seed + 100, centre, kEdge), 63,
                       neighboursAcross(63)};
    const ChunkMesh mesh = meshOf(bestKernels(), job);
    for (const MeshPart& seam : mesh.seams) {
      for (size_t i = 0; i < seam.vertices.size(); ++i) {
        const Vertex& v = seam.vertices[i];
        const bool of_own_level = seam.keys[i].level == grid.level;
        const Int3 at = vertexUnits(grid, v);
        const Evaluated e = evaluate(scalarKernels(), (of_own_level ? job.field : job.coarse)->view(),
                                     gridPoints({at, at}, 1).points());
        (of_own_level ? own : coarse) += 1;
        different += v.normal_x != e.nx[0] || v.normal_y != e.ny[0] || makeLabel(v.material, v.tag) != e.label[0];
      }
    }
  }
  INFO(own << " vertices of the chunk's level, " << coarse << " of the coarser one");
  CHECK(different == 0);
  CHECK(own > 100 * rounds(10));
  CHECK(coarse > 50 * rounds(10));
}

TEST_CASE("octrees of chunks whose levels' fields differ are closed, and every vertex link is one cycle") {
  // One or two fine octants among coarse ones, or one coarse octant among fine ones, so that octants of different
  // levels meet at faces, edges and corners.
  for (uint32_t seed = 1; seed <= 6; ++seed) {
    std::mt19937 random(seed);
    const uint8_t refined = static_cast<uint8_t>(seed == 1   ? 0x01
                                                 : seed == 2 ? 0xFE
                                                             : 1u << random() % 8 | 1u << random() % 8);
    std::array<std::shared_ptr<const FieldProgram>, 3> fields;
    for (int level = 0; level < 3; ++level) {
      // Each level has the same big sphere with different noise, and void around it, so that the whole surface is
      // closed.
      ProgramBuilder b(kCell, false, 0);
      const Int3 centre{2 * kEdge, 2 * kEdge, 2 * kEdge};
      const Value ball = b.sphere(centre, 1.7f * static_cast<float>(kEdge), makeLabel(1, 0));
      NoiseSpec noise{{}, 9 * kCell, 3, seed * 7 + static_cast<uint32_t>(level)};
      const Value wobble = b.binary(Op::multiply, b.constant(3.0f), b.noise(noise, 3));
      (void)b.group(b.binary(Op::displace, ball, wobble), IntBox::everything(), 0, false);
      (void)b.group(
          b.sphere({2 * kEdge + 900, 2 * kEdge, 2 * kEdge}, 0.8f * static_cast<float>(kEdge), makeLabel(2, 1)),
          IntBox::everything(), 0, true);
      fields[static_cast<size_t>(level)] = std::make_shared<FieldProgram>(b.finish());
    }
    // Fine and coarse octants must not alternate around an edge of the octree, so octants are refined until none do.
    uint8_t mask = refined;
    auto fine = [&](int x, int y, int z) { return mask >> (x + 2 * y + 4 * z) & 1; };
    for (bool changed = true; changed;) {
      changed = false;
      for (int axis = 0; axis < 3; ++axis) {
        for (int along = 0; along < 2; ++along) {
          auto bit = [&](int u, int v) {
            std::array<int, 3> p{};
            p[static_cast<size_t>(axis)] = along;
            p[static_cast<size_t>((axis + 1) % 3)] = u;
            p[static_cast<size_t>((axis + 2) % 3)] = v;
            return p[0] + 2 * p[1] + 4 * p[2];
          };
          auto is = [&](int u, int v) { return (mask >> bit(u, v) & 1) != 0; };
          if (is(0, 0) == is(1, 1) && is(0, 1) == is(1, 0) && is(0, 0) != is(0, 1)) {
            mask |= static_cast<uint8_t>(1 << bit(0, 0) | 1 << bit(0, 1));
            changed = true;
          }
        }
      }
    }
    // There are two octants along each axis; each is one chunk of level 1 or eight chunks of level 0.
    std::vector<ChunkMesh> meshes;
    std::vector<ChunkGrid> grids;
    auto isFine = [&](int x, int y, int z) {  // coordinates count chunks of level 0, from 0 to 3
      return x >= 0 && y >= 0 && z >= 0 && x < 4 && y < 4 && z < 4 && fine(x / 2, y / 2, z / 2);
    };
    auto isInside = [](int x, int y, int z) { return x >= 0 && y >= 0 && z >= 0 && x < 4 && y < 4 && z < 4; };
    for (int z = 0; z < 4; ++z) {
      for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
          const bool small = isFine(x, y, z);
          if (!small && (x % 2 || y % 2 || z % 2)) continue;
          ChunkJob job;
          job.grid = small ? gridAt(0, {x, y, z}) : gridAt(1, {x / 2, y / 2, z / 2});
          job.field = fields[small ? 0 : 1];
          job.coarse = fields[small ? 1 : 2];
          if (small) {
            for (int dz = -1; dz <= 1; ++dz) {
              for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                  if (isInside(x + dx, y + dy, z + dz) && !isFine(x + dx, y + dy, z + dz))
                    job.coarser |= neighbourBit(dx, dy, dz);
                }
              }
            }
            for (int f = 0; f < 6; ++f) {
              if (job.coarser & neighbourBit(static_cast<Face>(f))) job.seams |= static_cast<uint8_t>(1u << f);
            }
          }
          meshes.push_back(meshOf(bestKernels(), job));
          grids.push_back(job.grid);
        }
      }
    }
    std::vector<PlacedPart> parts;
    size_t in_seams = 0;
    for (size_t i = 0; i < meshes.size(); ++i) {
      parts.push_back({&meshes[i].body, grids[i], 0});
      for (size_t f = 0; f < meshes[i].seams.size(); ++f) {
        parts.push_back({&meshes[i].seams[f], grids[i], 1 + static_cast<int>(f)});
        in_seams += meshes[i].seams[f].indices.size() / 3;
      }
    }
    Result<WorldMesh> whole = weld(parts, {});
    REQUIRE(whole);
    const MeshReport report = checkTriangles(whole->indices, whole->keys.size());
    INFO("seed " << seed << ", refined " << int{mask} << ", " << report.triangles << " triangles, " << in_seams
                 << " in seams");
    CHECK(report.closed());
    CHECK(report.manifold());
    CHECK((mask == 0xFF || in_seams > 0));

    // Checks that the tests above can fail: if a seam is removed, the mesh has a gap.
    for (size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].number == 0 || parts[i].mesh->indices.empty()) continue;
      std::vector<PlacedPart> fewer = parts;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      Result<WorldMesh> torn = weld(fewer, {});
      REQUIRE(torn);
      CHECK_FALSE(checkTriangles(torn->indices, torn->keys.size()).closed());
      break;
    }
  }
}

TEST_CASE("a backend runs batches, cancels them, and refuses what it cannot do", "[threads]") {
  const auto jobs = *makeThreadPool(3);
  const auto field = programAround(5, {kEdge, kEdge, kEdge}, kEdge);
  auto batchOf = [&](int count) {
    std::vector<ChunkJob> list;
    for (int i = 0; i < count; ++i) list.push_back({gridAt(0, {i % 3, i / 3 % 3, 0}), field, nullptr, 0, 0});
    return list;
  };
  Result<std::unique_ptr<Backend>> backend = makeBackend({}, *jobs, std::pmr::get_default_resource());
  REQUIRE(backend);
  CHECK((*backend)->capabilities().exact);

  SECTION("in order") {
    auto batch = (*backend)->submit(batchOf(9));
    REQUIRE(batch);
    (*batch)->wait();
    CHECK((*batch)->poll());
    auto meshes = (*batch)->take();
    REQUIRE(meshes);
    REQUIRE(meshes->size() == 9);
    for (int i = 0; i < 9; ++i) {
      CHECK(sameBytes((*meshes)[static_cast<size_t>(i)].body,
                      meshOf(scalarKernels(), batchOf(9)[static_cast<size_t>(i)]).body));
    }
  }
  SECTION("nothing to do") {
    auto batch = (*backend)->submit({});
    REQUIRE(batch);
    CHECK((*batch)->poll());
    (*batch)->wait();
    CHECK((*batch)->take());
  }
  SECTION("cancelled") {
    // This job system runs jobs only within help(), so no job begins before the batch is cancelled.
    class Holding final : public JobSystem {
     public:
      unsigned concurrency() const override { return 2; }
      void submit(void (*function)(void*), void* argument, int) override { held.emplace_back(function, argument); }
      bool help() override {
        if (held.empty()) return false;
        const auto [function, argument] = held.back();
        held.pop_back();
        function(argument);
        return true;
      }
      std::vector<std::pair<void (*)(void*), void*>> held;
    } holding;
    {
      const Result<std::unique_ptr<Backend>> idle = makeBackend({}, holding, std::pmr::get_default_resource());
      REQUIRE(idle);
      auto batch = (*idle)->submit(batchOf(20));
      REQUIRE(batch);
      CHECK_FALSE((*batch)->poll());
      (*batch)->cancel();
      (*batch)->wait();
      const auto meshes = (*batch)->take();
      REQUIRE_FALSE(meshes);
      CHECK(meshes.error().code == Code::cancelled);
      // The same batch without a cancellation is meshed completely.
      auto whole = (*idle)->submit(batchOf(2));
      REQUIRE(whole);
      (*whole)->wait();
      CHECK((*whole)->take());
    }
    while (holding.help()) continue;
  }
  SECTION("refused") {
    BackendRequest request;
    request.automatic = false;
    request.kind = BackendKind::cuda;
    const auto none = makeBackend(request, *jobs, std::pmr::get_default_resource());
    REQUIRE_FALSE(none);
    CHECK(none.error().code == Code::unsupported);
    BackendRequest odd;
    odd.instruction_set = "mmx";
    const auto unknown = makeBackend(odd, *jobs, std::pmr::get_default_resource());
    REQUIRE_FALSE(unknown);
    CHECK(unknown.error().message.find("scalar") != std::string::npos);
  }
}

TEST_CASE("N threads mesh N chunks at one time, whether or not anyone waits", "[threads]") {
  const auto field = programAround(5, {kEdge, kEdge, kEdge}, kEdge);
  for (const unsigned threads : {1u, 2u, 3u}) {
    for (const bool waits : {true, false}) {
      const auto jobs = *makeThreadPool(threads);
      const Result<std::unique_ptr<Backend>> backend = makeBackend({}, *jobs, std::pmr::get_default_resource());
      REQUIRE(backend);
      std::vector<ChunkJob> list;
      for (int i = 0; i < 30; ++i) list.push_back({gridAt(0, {i % 3, i / 3 % 3, 0}), field, nullptr, 0, 0});
      std::atomic<unsigned> now{0}, most{0}, calls{0};
      auto batch = (*backend)->submit(std::move(list), [&] {
        const unsigned mine = ++now;
        for (unsigned seen = most; seen < mine && !most.compare_exchange_weak(seen, mine);) continue;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        --now;
        ++calls;
        return true;
      });
      REQUIRE(batch);
      if (waits) (*batch)->wait();
      for (int i = 0; i < 100'000 && !(*batch)->poll(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      REQUIRE((*batch)->poll());
      INFO(threads << " threads");
      CHECK(most <= threads);
      CHECK(calls == 30);
      CHECK((*batch)->take());
    }
  }
}

TEST_CASE("what a chunk's job throws comes back from take, on the thread that asks", "[threads]") {
  // A C++ allocator of the caller that violates its contract by throwing an exception.
  class Throwing final : public std::pmr::memory_resource {
   public:
    std::atomic<bool> throws{false};

   private:
    void* do_allocate(size_t size, size_t alignment) override {
      if (throws) throw std::runtime_error("not memory");
      return std::pmr::new_delete_resource()->allocate(size, alignment);
    }
    void do_deallocate(void* memory, size_t size, size_t alignment) override {
      std::pmr::new_delete_resource()->deallocate(memory, size, alignment);
    }
    bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
  };
  const auto field = programAround(5, {kEdge, kEdge, kEdge}, kEdge);
  const auto jobs = *makeThreadPool(3);
  Throwing memory;
  const Result<std::unique_ptr<Backend>> backend = makeBackend({}, *jobs, &memory);
  REQUIRE(backend);
  std::vector<ChunkJob> list(9, ChunkJob{gridAt(0, {}), field, nullptr, 0, 0});
  memory.throws = true;
  auto batch = (*backend)->submit(list);
  REQUIRE(batch);
  (*batch)->wait();
  CHECK_THROWS_AS((*batch)->take(), std::runtime_error);
  memory.throws = false;
  batch = (*backend)->submit(list, []() -> bool { throw std::runtime_error("asked too often"); });
  REQUIRE(batch);
  (*batch)->wait();
  CHECK_THROWS_AS((*batch)->take(), std::runtime_error);
}

TEST_CASE("backends have names") {
  CHECK(std::string(backendName(BackendKind::cpu)) == "cpu");
  CHECK(std::string(backendName(BackendKind::vulkan)) == "vulkan");
  CHECK(std::string(backendName(BackendKind::cuda)) == "cuda");
}

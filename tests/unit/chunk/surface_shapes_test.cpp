// Tests texture coordinates of worlds: they follow the shapes of the surface, and are equal on both sides of a chunk's
// border.

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "base/hash.h"
#include "catch.h"
#include "chunk/chunk_surface.h"
#include "chunk/surface_materials.h"
#include "chunk/surface_shapes.h"
#include "mesh/feature_kind.h"
#include "mesh/vertex.h"
#include "world/edits.h"
#include "world/world_support.h"

using namespace sgm;

namespace {

/// Passages between balls; a ball has no texture coordinates of its own.
const char* const kPassages =
    "sgm 1; units m; domain infinite solid; layer net cell 48m reach 44m { start Node; }\n"
    "rule Node { cut { at(c()) sphere(6m); for f in cell.links(tree 2) { Way(c(), f); } } }\n"
    "rule Way(a, f) { tube(a, f.other.point(jitter 0.2), 2m, bend 4m); }\n";

std::string passages() {
  return replaced(replaced(kPassages, "c()) sphere", "hub(cell)) sphere"), "Way(c(), f)", "Way(hub(cell), f)") +
         "let hub(c) = c.point(jitter 0.2);\n";
}

/// Meshes a cube of the world in chunks of `level`. The cube is eight chunks of level 0 wide, and its lowest chunk of
/// level 0 is (low, low, low).
std::vector<ChunkSurface> surfacesFrom(const WorldField& field, int level, int32_t low) {
  std::vector<ChunkRequest> requests;
  const int32_t first = low >> level, last = (low + 8) >> level;
  for (int32_t z = first; z < last; ++z) {
    for (int32_t y = first; y < last; ++y) {
      for (int32_t x = first; x < last; ++x) requests.emplace_back().key = {level, {x, y, z}};
    }
  }
  std::vector<ChunkSurface> surfaces;
  std::pmr::vector<PlacedChunk> chunks = meshAll(field, requests, 2);
  for (size_t i = 0; i < chunks.size(); ++i) {
    surfaces.push_back(surfaceOf(requests[i], std::move(chunks[i]), nullptr, field.memory()));
  }
  return surfaces;
}

uint16_t materialNamed(const Program& program, std::string_view name) {
  for (size_t i = 0; i < program.materials.size(); ++i) {
    if (std::string_view(program.materials[i]) == name) return static_cast<uint16_t>(i);
  }
  FAIL("no such material");
  return 0;
}

}  // namespace

TEST_CASE("chunks that meet have the same texture coordinates on their border") {
  for (const char* sampled : {"passages", "cave"}) {
    CAPTURE(sampled);
    const bool in_cave = sampled == std::string("cave");
    const std::string text = in_cave ? caveText() : passages();
    const WorldField field(settingsOf(text, 512, 3), std::pmr::get_default_resource());
    for (int level = 0; level < 2; ++level) {
      // Texture coordinates of the vertices on borders, by position and then by chunk.
      std::map<std::array<int64_t, 3>, std::map<size_t, std::vector<Wedge>>> shared;
      size_t chunk = 0, vertices = 0;
      for (const ChunkSurface& surface : surfacesFrom(field, level, in_cave ? 2 : -4)) {
        if (surface.mesh.indices.empty()) continue;
        ++chunk;
        const Result<Unwrapped> texture =
            unwrapChunk(field, surface.mesh, surface.grid, nullptr, kTile, std::pmr::get_default_resource());
        REQUIRE(texture);
        REQUIRE(texture->corners.size() == surface.mesh.indices.size());
        vertices += surface.mesh.vertices.size();
        for (const Wedge& wedge : texture->wedges) {
          const Vertex& v = surface.mesh.vertices[wedge.vertex];
          std::array<int64_t, 3> place{};
          const std::array<int16_t, 3> at{v.x, v.y, v.z};
          bool border = false;
          for (size_t axis = 0; axis < 3; ++axis) {
            place[axis] =
                int64_t{surface.grid.origin[static_cast<int>(axis)]} * kSubcell + int64_t{at[axis]} * surface.grid.cell;
            border = border || at[axis] == 0 || at[axis] == kChunkCells * kSubcell;
          }
          if (border) shared[place][chunk].push_back(wedge);
        }
        // Unwraps the chunk again with a new field that has derived nothing yet: the bytes must be the same.
        const WorldField fresh(settingsOf(text, 512, 3), std::pmr::get_default_resource());
        const Result<Unwrapped> again =
            unwrapChunk(fresh, surface.mesh, surface.grid, nullptr, kTile, std::pmr::get_default_resource());
        REQUIRE(again);
        CHECK(*again == *texture);
      }
      REQUIRE(vertices > 1000);
      size_t pairs = 0, same = 0, blends = 0;
      for (const auto& [place, chunks] : shared) {
        if (chunks.size() < 2) continue;
        ++pairs;
        const auto alike = [](const Wedge& a, const Wedge& b) {
          const float u = a.u - b.u, v = a.v - b.v;
          return std::fabs(u - std::round(u)) < 1e-3f && std::fabs(v - std::round(v)) < 1e-3f;
        };
        bool meets = false;
        for (const Wedge& a : chunks.begin()->second) {
          for (const Wedge& b : std::next(chunks.begin())->second) meets = meets || alike(a, b);
        }
        same += meets;
        for (const Wedge& a : chunks.begin()->second) {
          for (const Wedge& b : std::next(chunks.begin())->second) {
            if (a.materials != b.materials) continue;
            ++blends;
            CHECK(a.share == b.share);
          }
        }
      }
      REQUIRE(pairs > 100);
      REQUIRE(blends > 100);
      // Texture coordinates may differ where two shapes, or two charts, meet at the border of chunks.
      CHECK(static_cast<double>(same) > 0.9 * static_cast<double>(pairs));
    }
  }
}

TEST_CASE("a seam's vertices have the coordinates and blends of the coarser chunks, too") {
  for (const char* sampled : {"passages", "cave"}) {
    CAPTURE(sampled);
    const bool in_cave = sampled == std::string("cave");
    const WorldField field(settingsOf(in_cave ? caveText() : passages(), 512, 3), std::pmr::get_default_resource());
    const auto textured = [&](const ChunkRequest& request) {
      std::pmr::vector<PlacedChunk> chunks = meshAll(field, {request}, 1);
      ChunkSurface surface = surfaceOf(request, std::move(chunks[0]), nullptr, field.memory());
      Result<Unwrapped> texture =
          unwrapChunk(field, surface.mesh, surface.grid, nullptr, kTile, std::pmr::get_default_resource());
      REQUIRE(texture);
      surface.texture = std::move(*texture);
      return surface;
    };
    const auto placeOf = [](const ChunkSurface& surface, const Vertex& v) {
      const std::array<int16_t, 3> at{v.x, v.y, v.z};
      std::array<int64_t, 3> place{};
      for (size_t axis = 0; axis < 3; ++axis) {
        place[axis] =
            int64_t{surface.grid.origin[static_cast<int>(axis)]} * kSubcell + int64_t{at[axis]} * surface.grid.cell;
      }
      return place;
    };
    size_t met = 0, same = 0, blends = 0;
    const int32_t low = in_cave ? 2 : -4;
    for (int32_t i = 0; i < 512; ++i) {
      // Uses only chunks whose upper x face lies in a face of a chunk of level 1.
      const Int3 at{low + (i & 7), low + (i >> 3 & 7), low + (i >> 6)};
      if ((at.x & 1) == 0) continue;
      ChunkRequest fine;
      fine.key = {0, at};
      fine.seams = 1u << static_cast<int>(Face::x_hi);
      fine.coarser = neighboursAcross(fine.seams);
      const ChunkSurface seam = textured(fine);
      if (seam.mesh.ranges[2].index_count == 0) continue;
      ChunkRequest coarse;
      coarse.key = {1, {(at.x + 1) >> 1, at.y >> 1, at.z >> 1}};
      const ChunkSurface beyond = textured(coarse);
      std::map<std::array<int64_t, 3>, std::vector<Wedge>> theirs;
      for (const Wedge& wedge : beyond.texture.wedges) {
        theirs[placeOf(beyond, beyond.mesh.vertices[wedge.vertex])].push_back(wedge);
      }
      for (const Wedge& ours : seam.texture.wedges) {
        const Vertex& v = seam.mesh.vertices[ours.vertex];
        if (v.kind != kCoarserEdge) continue;
        const auto found = theirs.find(placeOf(seam, v));
        REQUIRE(found != theirs.end());
        ++met;
        bool alike = false;
        for (const Wedge& other : found->second) {
          const float du = ours.u - other.u, dv = ours.v - other.v;
          alike = alike || (std::fabs(du - std::round(du)) < 1e-3f && std::fabs(dv - std::round(dv)) < 1e-3f);
          if (ours.materials != other.materials) continue;
          ++blends;
          CHECK(ours.share == other.share);
        }
        same += alike;
      }
    }
    CAPTURE(met, same, blends);
    REQUIRE(met > 200);
    REQUIRE(blends > 200);
    CHECK(static_cast<double>(same) > 0.9 * static_cast<double>(met));
  }
}

TEST_CASE("the wedges of some chunks have the bytes that they had") {
  const WorldField field(settingsOf(caveText(), 512, 7), std::pmr::get_default_resource());
  uint64_t sum = 0;
  size_t wedges = 0;
  const auto add = [&sum](uint64_t word) { sum = hashCombine(sum, word); };
  for (int level = 0; level < 2; ++level) {
    for (const ChunkSurface& surface : surfacesFrom(field, level, 4)) {
      const Result<Unwrapped> texture =
          unwrapChunk(field, surface.mesh, surface.grid, nullptr, kTile, std::pmr::get_default_resource());
      REQUIRE(texture);
      for (const Wedge& wedge : texture->wedges) {
        add(wedge.vertex | uint64_t{wedge.share} << 32);
        add(std::bit_cast<uint32_t>(wedge.u) | uint64_t{std::bit_cast<uint32_t>(wedge.v)} << 32);
        add(wedge.materials[0] | uint64_t{wedge.materials[1]} << 16 | uint64_t{wedge.plane_shares[0]} << 32 |
            uint64_t{wedge.plane_shares[1]} << 40 | uint64_t{wedge.plane_shares[2]} << 48);
      }
      for (const uint32_t corner : texture->corners) add(corner);
      wedges += texture->wedges.size();
    }
  }
  CHECK(wedges == 47540);
  CHECK(sum == 0x5b8c66282a68bbf8u);
}

TEST_CASE("where two materials meet one passes into the other over two cells, on every level") {
  const WorldField field(settingsOf("sgm 1; units m; domain finite box(48m, 16m, 16m); start A;\n"
                                    "rule A { at(-10.1m, 0m, 0m) Part; at(10m, 0m, 0m) Half; }\n"
                                    "rule Part { box(20m, 6m, 6m); mat chalk; }\n"
                                    "rule Half { box(20.4m, 6m, 6m); mat flint; }\n",
                                    256),
                         std::pmr::get_default_resource());
  const uint16_t chalk = materialNamed(*field.settings().program, "chalk");
  const uint16_t flint = materialNamed(*field.settings().program, "flint");
  for (int level = 0; level < 3; ++level) {
    CAPTURE(level);
    const double cell = field.cellAt(level);
    std::vector<Int3> points;
    std::vector<TexturePoint> normals;
    for (int i = -40; i <= 40; ++i) {
      // The points lie just below the common face of the two boxes. On the face itself, both boxes are equally near,
      // and the first one would be chosen.
      points.push_back({static_cast<int32_t>(-154 + i * cell / 16), 2600, 100});
      normals.push_back({0, 2, 0});
    }
    std::vector<MaterialMix> mixes(points.size());
    REQUIRE(materialsAround(field, level, nullptr, points, normals, mixes));
    double before = -1;
    for (size_t i = 0; i < mixes.size(); ++i) {
      const auto flints = static_cast<double>(std::count(mixes[i].begin(), mixes[i].end(), flint));
      CHECK(std::count(mixes[i].begin(), mixes[i].end(), chalk) + static_cast<int>(flints) == kMaterialSamples);
      CHECK(flints >= before);
      before = flints;
      const double away = (points[i].x + 154) / cell;
      if (away < -1.05) CHECK(flints == 0);
      if (away > 1.05) CHECK(flints == kMaterialSamples);
      if (std::fabs(away) < 0.5) CHECK(std::fabs(flints - 4.5) <= 2);
    }
  }
}

TEST_CASE("surfaces of shapes finer than a cell are of the shapes' material") {
  const WorldField field(
      settingsOf("sgm 1; units m; domain infinite; layer l cell 16m reach 8m { start A; }\n"
                 "rule A { at(cell.point(jitter 0.4)) scatter 6 on shell(3m) { B(rand(0.3m, 2m)); } }\n"
                 "rule B(r) { sum { blob(r); } mat chalk; }\n",
                 256),
      std::pmr::get_default_resource());
  const uint16_t chalk = materialNamed(*field.settings().program, "chalk");
  for (int level = 0; level < 4; ++level) {
    CAPTURE(level);
    size_t vertices = 0;
    for (const ChunkSurface& surface : surfacesFrom(field, level, 0)) {
      std::vector<Int3> points;
      std::vector<TexturePoint> normals;
      for (const Vertex& vertex : surface.mesh.vertices) {
        if (isOfCoarserLevel(vertex.kind)) continue;
        points.push_back(vertexUnits(surface.grid, vertex));
        normals.push_back(unpackNormal(vertex.normal_x, vertex.normal_y));
      }
      std::vector<MaterialMix> mixes(points.size());
      REQUIRE(materialsAround(field, level, nullptr, points, normals, mixes));
      for (const MaterialMix& mix : mixes) CHECK(std::count(mix.begin(), mix.end(), chalk) == int{kMaterialSamples});
      vertices += points.size();
    }
    CHECK(vertices > 20);
  }
}

TEST_CASE("a passage is laid out along and around, a dig by the world's axes") {
  const WorldField field(settingsOf("sgm 1; units m; domain finite solid box(64m, 16m, 16m); start A;\n"
                                    "rule A { cut { tube((-28m, 0m, 0m), (28m, 0m, 0m), 3m); } }\n",
                                    256),
                         std::pmr::get_default_resource());
  EditLog log{EditSettings{}};
  Brush brush;
  brush.cut = true;
  brush.from = {0, 5000, 0};
  brush.radius = 3000;
  REQUIRE(log.add(brush));
  for (const bool dug : {false, true}) {
    CAPTURE(dug);
    const std::shared_ptr<const EditSnapshot> edits = dug ? log.snapshot() : nullptr;
    SurfaceShapes shapes(field, edits.get(), {}, kTile);
    const std::vector<Int3> points{{-9000, 3072, 0}, {9000, 3072, 0}, {9000, 0, 3072}, {0, 7990, 0}};
    std::vector<uint32_t> labels(points.size());
    REQUIRE(shapes.label(0, points, labels));
    CHECK(labels[0] == labels[1]);
    CHECK(labels[1] == labels[2]);
    CHECK(labels[0] != 0);
    if (dug) CHECK(labels[3] == 0);
    const TextureSpace& tube = shapes.space(labels[0]);
    const Chart chart = tube.chartOf({9000, 3072, 0}, {0, -1, 0});
    const TextureCoordinates a = tube.at({-9000, 3072, 0}, chart), b = tube.at({9000, 3072, 0}, chart);
    CHECK(b.v - a.v == Approx(18000.0 / kTile));
    CHECK(b.u == Approx(a.u).margin(1e-6));
    const TextureCoordinates side = tube.at({9000, 0, 3072}, chart);
    CHECK(std::fabs(side.u - b.u) == Approx(tube.period(chart).u / 4).epsilon(0.01));
    CHECK(side.v == Approx(b.v));
  }
}

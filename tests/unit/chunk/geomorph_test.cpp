// Tests the geomorph offsets to the next coarser level: they lead to that level's surface, and neighbouring chunks have
// equal offsets.

#include <cmath>
#include <map>

#include "backend/cpu/instruction_sets.h"
#include "catch.h"
#include "chunk/chunk_surface.h"
#include "chunk/geomorph.h"
#include "mesh/vertex.h"
#include "world/world_support.h"

using namespace sgm;

namespace {

constexpr int32_t kMorphCell = 512;

std::vector<ChunkRequest> block(int level, uint8_t seams) {
  std::vector<ChunkRequest> requests;
  for (int32_t i = 0; i < 27; ++i) {
    ChunkRequest request;
    request.key = {level, {4 + i % 3, 4 + i / 3 % 3, 4 + i / 9}};
    request.seams = seams;
    requests.push_back(request);
  }
  return requests;
}

/// Returns the field value of the next coarser level at the integer position nearest to `p`, which is in units.
double coarseValue(const WorldField& world, int level, const std::array<double, 3>& p) {
  Int3 at;
  for (int axis = 0; axis < 3; ++axis) at[axis] = static_cast<int32_t>(std::lround(p[static_cast<size_t>(axis)]));
  const auto program = world.compile({at, at}, level + 1);
  REQUIRE(program);
  EvalScratch scratch(std::pmr::get_default_resource());
  float value = 0;
  Attributes attributes;
  attributes.value = &value;
  bestKernels().attributes((*program)->view(), {&at.x, &at.y, &at.z, 1}, scratch, attributes);
  return static_cast<double>(value);
}

}  // namespace

TEST_CASE("morph offsets lead to the coarser surface, and neighbours agree") {
  // The coarser level omits the noise of this grammar, so that the two surfaces differ by fractions of a cell.
  const WorldField world(
      settingsOf("sgm 1; units m; domain infinite; layer l cell 64m reach 40m { start Ball; }\n"
                 "rule Ball { at(cell.center) { displace 0.4m*fractal(1.5m) amp 0.4m { sphere(26m); } } }\n",
                 kMorphCell),
      std::pmr::get_default_resource());
  const std::pmr::vector<PlacedChunk> chunks = meshAll(world, block(0, 63), 2);
  std::map<std::array<int32_t, 3>, MorphOffset> by_place;
  double before = 0, after = 0;
  size_t moved = 0, shared = 0, still = 0;
  for (const PlacedChunk& chunk : chunks) {
    const PackedMesh mesh = packMesh(partsOf(chunk.mesh), nullptr, std::pmr::get_default_resource());
    const auto offsets = morphOffsets(world, mesh, chunk.grid, nullptr, std::pmr::get_default_resource());
    REQUIRE(offsets);
    REQUIRE(offsets->size() == mesh.vertices.size());
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
      const Vertex& v = mesh.vertices[i];
      const MorphOffset offset = (*offsets)[i];
      if (v.kind != kOwnEdge) {
        CHECK(offset == MorphOffset{});
        ++still;
        continue;
      }
      const Int3 p = vertexUnits(chunk.grid, v);
      const auto [known, is_new] = by_place.try_emplace({p.x, p.y, p.z}, offset);
      if (!is_new) {
        CHECK(known->second == offset);
        ++shared;
        continue;
      }
      if (i % 16 != 0) continue;
      std::array<double, 3> to;
      for (size_t axis = 0; axis < 3; ++axis) {
        CHECK(std::abs(offset[axis]) <= kMaxMorph);
        to[axis] = p[static_cast<int>(axis)] + offset[axis] * chunk.grid.cell / 256.0;
      }
      before += std::pow(
          coarseValue(world, 0, {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)}), 2);
      after += std::pow(coarseValue(world, 0, to), 2);
      moved += offset != MorphOffset{};
    }
  }
  CAPTURE(moved, shared, still, before, after);
  CHECK(moved > 200);
  CHECK(shared > 200);
  CHECK(still > 50);
  CHECK(after < before / 25);
}

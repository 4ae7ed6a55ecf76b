// Tests the claims of the row Cabral in the paper's Table 4, with the sample that represents it: assets in many sizes
// whose angles and textures stay. Stretching is tested in tests/unit/asset; that meshes are closed, in
// tests/unit/region and by the sample's own `expect` statements.

#include <set>

#include "../grammar/compile_text.h"
#include "chunk/surface_shapes.h"
#include "mesh/vertex.h"
#include "rounds.h"
#include "world_support.h"

using namespace sgm;

namespace {

constexpr IntBox kStreet{{-80 * 1024, -10 * 1024, -80 * 1024}, {80 * 1024, 60 * 1024, 80 * 1024}};

WorldField worldOf(const std::string& text, int32_t cell, uint64_t seed) {
  test::FolderResolver files(std::string(SGM_SAMPLE_GRAMMARS) + "/table4");
  CompileOptions options;
  options.resolver = &files;
  const CompileResult compiled = compileGrammar(text, "test.sgm", options);
  INFO(renderDiagnostics(compiled));
  REQUIRE(compiled.program);
  WorldFieldSettings settings;
  settings.program = compiled.program;
  settings.parameters = ParameterValues::defaults(*compiled.program);
  settings.seed = seed;
  settings.finest_cell = cell;
  return {std::move(settings), std::pmr::get_default_resource()};
}

TexelDensity densityOf(const WorldField& world) {
  std::vector<ChunkRequest> requests;
  const int32_t edge = kChunkCells * world.cellAt(0);
  for (int32_t z = -8 * 1024 / edge - 1; z <= 8 * 1024 / edge; ++z)
    for (int32_t y = -8 * 1024 / edge - 1; y <= 8 * 1024 / edge; ++y)
      for (int32_t x = -8 * 1024 / edge - 1; x <= 8 * 1024 / edge; ++x) requests.emplace_back().key = {0, {x, y, z}};
  std::vector<TexturePoint> positions;
  Unwrapped all;
  std::vector<uint32_t> indices;
  for (const PlacedChunk& chunk : meshAll(world, requests, 2)) {
    const MeshPart& body = chunk.mesh.body;
    if (body.indices.empty()) continue;
    const uint32_t first = static_cast<uint32_t>(positions.size());
    for (const Vertex& vertex : body.vertices) {
      const auto at = [&](int axis, int16_t local) {
        return chunk.grid.origin[axis] + double{1} * local * chunk.grid.cell / kSubcell;
      };
      positions.push_back({at(0, vertex.x), at(1, vertex.y), at(2, vertex.z)});
    }
    PackedMesh packed;
    packed.vertices.assign(body.vertices.begin(), body.vertices.end());
    packed.indices.assign(body.indices.begin(), body.indices.end());
    const Result<Unwrapped> unwrapped = unwrapChunk(world, packed, chunk.grid, nullptr, kTile, world.memory());
    REQUIRE(unwrapped);
    const uint32_t first_wedge = static_cast<uint32_t>(all.wedges.size());
    for (Wedge wedge : unwrapped->wedges) {
      wedge.vertex += first;
      all.wedges.push_back(wedge);
    }
    for (const uint32_t corner : unwrapped->corners) all.corners.push_back(first_wedge + corner);
    for (const uint32_t index : packed.indices) indices.push_back(first + index);
  }
  UnwrapInput input;
  input.positions = positions;
  input.indices = indices;
  return texelDensity(input, all, kTile);
}

}  // namespace

TEST_CASE("Cabral: textures keep their scale in every size", "[table4]") {
  for (const char* how :
       {"size(6m, 9.6m, 5.12m) fit house", "size(9m, 14m, 5m) fit house",
        "rot(y, 33deg) size(7m, 12.6m, 9m) fit house stretch x 1.8m..2.5m repeat y 2.6m..5.6m stretch y 5.7m..9.6m",
        "size(13m, 6m, 7m) fit arcade repeat x 0.5m..3.5m"}) {
    INFO(how);
    const std::string asset = std::string(how).find("house") != std::string::npos ? "house" : "arcade";
    const TexelDensity density = densityOf(worldOf(
        "sgm 1; import \"assets/" + asset + ".glb\" as " + asset + "; start A; rule A { " + how + "; }", 64, 1));
    // On every face, a tile is one metre. Marching cubes cuts off edges and corners by slightly tilted triangles, which
    // are many on thin parts, such as window frames as thick as a cell.
    CHECK(density.middle == Approx(1).margin(0.002));
    CHECK(density.high == Approx(1).margin(0.01));
    CHECK(density.low > 0.87);
  }
}

TEST_CASE("Cabral: every house of the street fits, and none is as the other", "[table4]") {
  for (uint64_t seed = 0; seed < rounds(20); ++seed) {
    CAPTURE(seed);
    const WorldField world = worldOf(sample("table4/cabral.sgm"), 512, seed);
    const auto notes = world.notes(kStreet, 128);
    REQUIRE(notes);
    for (const auto& note : *notes) UNSCOPED_INFO(note.path << ": " << note.message);
    CHECK(notes->empty());
    const auto houses = world.instances(ruleNamed(*world.settings().program, "House"), kStreet, 1000);
    REQUIRE(houses);
    std::set<int32_t> widths;
    for (const RuleInstance& house : *houses) {
      REQUIRE(house.chunk.groups.size() == 1);
      const IntBox& box = house.chunk.groups[0].bounds;
      widths.insert(box.hi.x - box.lo.x);
      CHECK(box.lo.y <= 0);
      CHECK(box.lo.y >= -16);
    }
    CHECK(houses->size() >= 8);
    CHECK(widths.size() >= houses->size() - 1);
  }
}

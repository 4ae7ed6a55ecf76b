// Tests that normals point out of the solid, for all kinds of shapes.

#include "catch.h"
#include "mesh/vertex.h"
#include "world/world_support.h"

using namespace sgm;

namespace {

/// Returns the share of the mesh's area that is in triangles whose vertex normals have a sum that points backwards.
double shareAstray(const std::string& rules) {
  const WorldField world(settingsOf("sgm 1; units m; start Main;\n" + rules, 128), std::pmr::get_default_resource());
  std::vector<ChunkRequest> requests;
  for (int i = 0; i < 64; ++i) requests.push_back({{0, {(i & 3) - 2, (i >> 2 & 3) - 2, (i >> 4) - 2}}});
  double all = 0, astray = 0;
  for (const PlacedChunk& chunk : meshAll(world, requests, 2)) {
    const MeshPart& body = chunk.mesh.body;
    for (size_t i = 0; i < body.indices.size(); i += 3) {
      std::array<std::array<double, 3>, 3> at{};
      std::array<double, 3> normal{};
      for (size_t c = 0; c < 3; ++c) {
        const Vertex& v = body.vertices[body.indices[i + c]];
        at[c] = {v.x / 256.0, v.y / 256.0, v.z / 256.0};
        const std::array<double, 3> n = unpackNormal(v.normal_x, v.normal_y);
        for (size_t k = 0; k < 3; ++k) normal[k] += n[k];
      }
      std::array<double, 3> area{};
      double along = 0, square = 0;
      for (size_t k = 0; k < 3; ++k) {
        const size_t u = (k + 1) % 3, v = (k + 2) % 3;
        area[k] = (at[1][u] - at[0][u]) * (at[2][v] - at[0][v]) - (at[1][v] - at[0][v]) * (at[2][u] - at[0][u]);
        along += area[k] * normal[k];
        square += area[k] * area[k];
      }
      all += std::sqrt(square);
      astray += along < 0 ? std::sqrt(square) : 0;
    }
  }
  REQUIRE(all > 100);
  return astray / all;
}

}  // namespace

TEST_CASE("normals point out of prisms of either order, of what is extruded, of roofs, and into what is cut") {
  for (const char* rules : {
           "rule Main { box(5m, 4m, 6m); }",
           "rule Main { prism(3m, (-3m, -3m), (3m, -3m), (0m, 3m)); }",
           "rule Main { prism(3m, (-3m, -3m), (0m, 3m), (3m, -3m)); }",
           "rule Main { mirror(x) rot(y, 20deg) prism(3m, (-3m, -3m), (0m, 3m), (3m, -3m)); }",
           "rule Main { prism(4m, (-3m, -3m), (3m, -3m), (3m, 0m), (0m, 0m), (0m, 3m), (-3m, 3m)); }",
           "rule Main { box(7m, 3m, 7m); cut { prism(4m, (-2m, -2m), (2m, -2m), (0m, 2m)); } }",
           "rule Main { footprint rect(5m, 4m) as plan; extrude 3m of plan { Mass; } } rule Mass { }",
           "rule Main { footprint regular(6, 3m) as plan; extrude 3m of plan; }",
           "rule Main { footprint merge 3 rect(5m, 4m) as plan; extrude 3m of plan; roof gable(35deg) of plan; }",
           "rule Main { size(6m, 2m, 5m) roof gable(30deg); }",
           "rule Main { size(6m, 2m, 5m) roof flat(1m); }",
           "rule Main { size(6m, 2m, 5m) roof hip(30deg, overhang 0.5m); }",
       }) {
    CAPTURE(rules);
    CHECK(shareAstray(rules) < 0.02);
  }
}

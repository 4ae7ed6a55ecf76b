// GLB files as tools write them, and files that lie about themselves.

#include "asset/glb_reader.h"

#include <cstring>
#include <random>

#include "bodies.h"
#include "catch.h"
#include "glb_bytes.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

Result<TriangleMesh> read(const std::string& bytes, const GlbLimits& limits = {}) {
  return readGlb(std::as_bytes(std::span(bytes)), limits);
}

std::string refusal(const std::string& bytes, const GlbLimits& limits = {}) {
  const auto mesh = read(bytes, limits);
  return mesh ? "" : mesh.error().message;
}

/// Three points of a triangle, then their numbers as bytes, shorts and words.
std::string triangleBytes() {
  const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::string out(reinterpret_cast<const char*>(points), sizeof points);
  const unsigned char bytes[4] = {0, 1, 2, 0};
  const uint16_t shorts[4] = {0, 1, 2, 0};
  const uint32_t words[3] = {0, 1, 2};
  out.append(reinterpret_cast<const char*>(bytes), sizeof bytes);
  out.append(reinterpret_cast<const char*>(shorts), sizeof shorts);
  out.append(reinterpret_cast<const char*>(words), sizeof words);
  return out;
}

/// A file of one triangle. In the texts a part may be replaced: from, to.
std::string triangleFile(const std::string& from = "", const std::string& to = "") {
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("materials":[{"name":"brick"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],)"
      R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":40,"byteLength":6},)"
      R"({"buffer":0,"byteOffset":36,"byteLength":3},{"buffer":0,"byteOffset":48,"byteLength":12}],)"
      R"("buffers":[{"byteLength":60}]})";
  if (!from.empty()) {
    const size_t at = json.find(from);
    REQUIRE(at != std::string::npos);
    json.replace(at, from.size(), to);
  }
  return glbOf(json, triangleBytes());
}

}  // namespace

TEST_CASE("a file's triangles come with materials, whatever counts their corners", "[asset][glb]") {
  for (const char* indices : {R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"})",
                              R"({"bufferView":2,"componentType":5121,"count":3,"type":"SCALAR"})",
                              R"({"bufferView":3,"componentType":5125,"count":3,"type":"SCALAR"})"}) {
    const auto mesh = read(triangleFile(R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"})", indices));
    REQUIRE(mesh);
    REQUIRE(mesh->triangles.size() == 1);
    CHECK(mesh->points[mesh->triangles[0][1]] == Point{1, 0, 0});
    CHECK(mesh->points[mesh->triangles[0][2]] == Point{0, 1, 0});
    CHECK(mesh->material_names == std::vector<std::string>{"brick"});
    CHECK(mesh->materials == std::vector<uint32_t>{0});
  }
  const auto bare = read(triangleFile(R"(,"indices":1,"material":0)", ""));
  REQUIRE(bare);
  CHECK(bare->materials == std::vector<uint32_t>{kNoMaterial});
  const auto round = read(glbOf(gabledHouse()));
  REQUIRE(round);
  CHECK(round->triangles.size() == gabledHouse().triangles.size());
}

TEST_CASE("nodes move, turn, scale and mirror what they show", "[asset][glb]") {
  const auto moved = [](const std::string& how) {
    const auto mesh = read(triangleFile(R"({"mesh":0})", R"({"mesh":0,)" + how + "}"));
    REQUIRE(mesh);
    std::vector<Point> out;
    for (const uint32_t corner : mesh->triangles[0]) out.push_back(mesh->points[corner]);
    return out;
  };
  const auto near = [](Point a, Point b) { return length(a - b) < 1e-12; };
  CHECK(near(moved(R"("translation":[1,2,3])")[1], {2, 2, 3}));
  CHECK(near(moved(R"("rotation":[0,0,0.7071067811865476,0.7071067811865476])")[1], {0, 1, 0}));
  CHECK(near(moved(R"("scale":[2,3,4])")[2], {0, 3, 0}));
  CHECK(near(moved(R"("matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,5,6,7,1])")[1], {5, 7, 7}));
  // Mirrored, it still looks out to the same side.
  const auto mirrored = moved(R"("scale":[-1,1,1])");
  CHECK(near(normalised(cross(mirrored[1] - mirrored[0], mirrored[2] - mirrored[0])), {0, 0, 1}));
  // A child is moved by its parent, and last by itself.
  const auto mesh = read(triangleFile(
      R"("nodes":[{"mesh":0}])", R"("nodes":[{"children":[1],"scale":[2,2,2]},{"mesh":0,"translation":[1,0,0]}])"));
  REQUIRE(mesh);
  CHECK(mesh->points[mesh->triangles[0][1]] == Point{4, 0, 0});
  // Without a scene, all nodes are shown that are nobody's children.
  CHECK(read(triangleFile(R"("scene":0,"scenes":[{"nodes":[0]}],)", "")));
}

TEST_CASE("what a file says wrongly of itself is one clear error", "[asset][glb]") {
  CHECK(refusal("") == "it is no GLB file: it does not begin with `glTF`");
  CHECK(refusal("sgm 1; start Ball; rule Ball { sphere(1m); }") == "it is no GLB file: it does not begin with `glTF`");
  std::string bytes = triangleFile();
  bytes[4] = 1;
  CHECK(refusal(bytes) == "it is glTF of version 1, not 2");
  bytes = triangleFile();
  CHECK(refusal(bytes.substr(0, bytes.size() - 1)) ==
        "it says that it has " + std::to_string(bytes.size()) + " bytes, and has " + std::to_string(bytes.size() - 1));
  bytes[12] = '\xFF', bytes[13] = '\xFF', bytes[14] = '\xFF', bytes[15] = '\xFF';
  CHECK(refusal(bytes) == "a part of it reaches beyond its end");
  bytes = triangleFile();
  bytes[16] = 'X';
  CHECK(refusal(bytes) == "its first part is not JSON");
  struct Case {
    const char *from, *to, *message;
  };
  const Case cases[] = {
      {R"("asset")", R"("asset)", "`:` is missing at byte 10 of its JSON"},
      {R"("asset":{"version":"2.0"})", R"("extensionsRequired":["KHR_draco_mesh_compression"])",
       "it needs the extension `KHR_draco_mesh_compression`"},
      {R"("scene":0)", R"("scene":1)", "its scene is not there"},
      {R"("scenes":[{"nodes":[0]}])", R"("scenes":[{"nodes":[7]}])", "a node that is named is not there"},
      {R"("nodes":[{"mesh":0}])", R"("nodes":[{"mesh":0,"children":[0]}])",
       "node 0 stands below two others, or too deep"},
      {R"({"mesh":0})", R"({"mesh":4})", "node 0 shows a mesh that is not there"},
      {R"({"mesh":0})", R"({"mesh":0,"scale":[1,2]})",
       "node 0 is moved by what are not numbers, or not as many as it takes"},
      {R"({"mesh":0})", R"({"mesh":0,"rotation":[0,0,0,0]})", "node 0 is turned by a quaternion without a length"},
      {R"({"mesh":0})", R"({"name":"empty"})", "it shows no triangles"},
      {R"("indices":1)", R"("indices":1,"mode":1)", "mesh 0 is not made of triangles"},
      {R"("POSITION":0)", R"("NORMAL":0)", "mesh 0 has no positions"},
      {R"("indices":1)", R"("indices":-1)", "mesh 0 has indices that are not there"},
      {R"("indices":1)", R"("indices":2)", "accessor 2 is not there"},
      {R"("componentType":5123,"count":3)", R"("componentType":5123,"count":2)", "mesh 0 ends within a triangle"},
      {R"("count":3,"type":"VEC3")", R"("count":2,"type":"VEC3")",
       "mesh 0 has a triangle with a corner that is not there"},
      {R"("type":"VEC3")", R"("type":"VEC2")", "accessor 0 is not of type VEC3"},
      {R"("componentType":5126)", R"("componentType":5123)", "accessor 0 does not hold floats"},
      {R"("componentType":5123)", R"("componentType":5122)", "accessor 1 does not hold unsigned whole numbers"},
      {R"("count":3,"type":"VEC3")", R"("count":0,"type":"VEC3")", "accessor 0 holds nothing"},
      {R"("count":3,"type":"VEC3")", R"("count":4,"type":"VEC3")",
       "accessor 0 reaches beyond the end of its buffer view"},
      {R"("count":3,"type":"VEC3")", R"("count":3,"byteOffset":9007199254740992,"type":"VEC3")",
       "accessor 0 reaches beyond the end of its buffer view"},
      {R"("count":3,"type":"VEC3")", R"("count":3,"sparse":{},"type":"VEC3")", "accessor 0 is sparse"},
      {R"("bufferView":0,)", R"("bufferView":9,)", "accessor 0 has no buffer view"},
      {R"("buffer":0,"byteOffset":0)", R"("buffer":1,"byteOffset":0)",
       "buffer view 0 is not of the file's own binary part"},
      {R"("byteLength":36)", R"("byteLength":9007199254740992)",
       "buffer view 0 reaches beyond the end of the binary part"},
      {R"("byteLength":36)", R"("byteLength":36,"byteStride":8)",
       "buffer view 0 has a stride that its elements do not fit into"},
      {R"("byteLength":36)", R"("byteLength":36,"byteStride":24)",
       "accessor 0 reaches beyond the end of its buffer view"},
  };
  for (const Case& one : cases) {
    INFO(one.to);
    CHECK(refusal(triangleFile(one.from, one.to)) == one.message);
  }
  std::string nan = triangleFile();
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(nan.data() + nan.size() - 60, &not_a_number, 4);
  CHECK(refusal(nan) == "accessor 0 has a position that is no place within 1,000 km");
}

TEST_CASE("what a file may ask for is capped", "[asset][glb]") {
  CHECK(refusal(triangleFile(), {.json_bytes = 10}) == "its JSON has more than 10 bytes");
  CHECK(refusal(triangleFile(), {.points = 2}) == "accessor 0 holds more than 2 elements");
  CHECK(refusal(triangleFile(), {.triangles = 0}) == "accessor 1 holds more than 0 elements");
  CHECK(refusal(triangleFile(R"(,"indices":1)", ""), {.triangles = 0}) == "it has more than 0 triangles");
  CHECK(refusal(triangleFile(), {.nodes = 0}) == "it has more than 0 nodes");
}

TEST_CASE("no damage to a file does any harm", "[asset][glb]") {
  std::mt19937 random(11);
  const std::string good = glbOf(gabledHouse());
  for (size_t round = 0; round < rounds(3000); ++round) {
    std::string bytes = good;
    for (size_t k = 0; k < 1 + random() % 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (const auto mesh = read(bytes)) CHECK(mesh->materials.size() == mesh->triangles.size());
  }
}

// Tests reading GLB files as tools write them, and inconsistent ones.

#include "asset/read/glb_reader.h"

#include <cstring>
#include <random>

#include "bodies.h"
#include "catch.h"
#include "glb_bytes.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

Result<TriangleMesh> read(const std::string& bytes, const MeshLimits& limits = {}) {
  return readGlb(std::as_bytes(std::span(bytes)), limits);
}

std::string refusal(const std::string& bytes, const MeshLimits& limits = {}) {
  const auto mesh = read(bytes, limits);
  return mesh ? "" : mesh.error().message;
}

/// The positions of a triangle's corners, followed by its indices as 8-bit, 16-bit and 32-bit numbers.
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

/// A file with one triangle. In its JSON, the text `from` is replaced by `to`.
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
  // A triangle of a mirrored node still faces the same side.
  const auto mirrored = moved(R"("scale":[-1,1,1])");
  CHECK(near(normalised(cross(mirrored[1] - mirrored[0], mirrored[2] - mirrored[0])), {0, 0, 1}));
  // A child node's transform is applied first, then its parent's.
  const auto mesh = read(triangleFile(
      R"("nodes":[{"mesh":0}])", R"("nodes":[{"children":[1],"scale":[2,2,2]},{"mesh":0,"translation":[1,0,0]}])"));
  REQUIRE(mesh);
  CHECK(mesh->points[mesh->triangles[0][1]] == Point{4, 0, 0});
  // If the file names no scene, all root nodes are read.
  CHECK(read(triangleFile(R"("scene":0,"scenes":[{"nodes":[0]}],)", "")));
}

TEST_CASE("what a file says wrongly of itself is one clear error", "[asset][glb]") {
  CHECK(refusal("") == "it is not a GLB file: it does not begin with `glTF`");
  CHECK(refusal("sgm 1; start Ball; rule Ball { sphere(1m); }") ==
        "it is not a GLB file: it does not begin with `glTF`");
  std::string bytes = triangleFile();
  bytes[4] = 1;
  CHECK(refusal(bytes) == "it is glTF of version 1, not 2, at byte 4");
  bytes = triangleFile();
  CHECK(refusal(bytes.substr(0, bytes.size() - 1)) == "its header declares " + std::to_string(bytes.size()) +
                                                          " bytes, and the file has " +
                                                          std::to_string(bytes.size() - 1) + ", at byte 8");
  bytes[12] = '\xFF', bytes[13] = '\xFF', bytes[14] = '\xFF', bytes[15] = '\xFF';
  CHECK(refusal(bytes) == "a chunk of it reaches beyond its end, at byte 12");
  bytes = triangleFile();
  bytes[16] = 'X';
  CHECK(refusal(bytes) == "its first chunk is not JSON, at byte 16");
  struct Case {
    const char *from, *to, *message;
  };
  const Case cases[] = {
      {R"("asset")", R"("asset)", "`:` is missing at byte 10 of its JSON"},
      {R"("asset":{"version":"2.0"})", R"("extensionsRequired":["KHR_draco_mesh_compression"])",
       "it needs the extension `KHR_draco_mesh_compression`, at /extensionsRequired of its JSON"},
      {R"("scene":0)", R"("scene":1)", "its scene does not exist, at /scene of its JSON"},
      {R"("scenes":[{"nodes":[0]}])", R"("scenes":[{"nodes":[7]}])",
       "it refers to a node that does not exist, at /scenes/0/nodes of its JSON"},
      {R"("nodes":[{"mesh":0}])", R"("nodes":[{"mesh":0,"children":[0]}])",
       "node 0 stands below two others, or below itself, at /nodes/0/children of its JSON"},
      {R"({"mesh":0})", R"({"mesh":4})", "node 0 refers to a mesh that does not exist, at /nodes/0/mesh of its JSON"},
      {R"({"mesh":0})", R"({"mesh":0,"scale":[1,2]})",
       "node 0 has a transform with values that are not numbers, or a wrong count of them, at /nodes/0 of its JSON"},
      {R"({"mesh":0})", R"({"mesh":0,"rotation":[0,0,0,0]})",
       "node 0 is turned by a quaternion without a length, at /nodes/0 of its JSON"},
      {R"({"mesh":0})", R"({"name":"empty"})", "it shows no triangles"},
      {R"("indices":1)", R"("indices":1,"mode":1)",
       "it shows no triangles: 1 primitive of lines or points is left out, at /meshes/0/primitives/0 of its JSON"},
      {R"("indices":1)", R"("indices":1,"mode":7)",
       "mesh 0 has a mode that glTF does not have, at /meshes/0/primitives/0/mode of its JSON"},
      {R"("POSITION":0)", R"("NORMAL":0)",
       "it shows no triangles: 1 primitive has no positions and is left out, at /meshes/0/primitives/0 of its JSON"},
      {R"("indices":1)", R"("indices":-1)",
       "mesh 0 refers to indices that do not exist, at /meshes/0/primitives/0/indices of its JSON"},
      {R"("indices":1)", R"("indices":2)",
       "mesh 0 refers to indices that do not exist, at /meshes/0/primitives/0/indices of its JSON"},
      {R"("componentType":5123,"count":3)", R"("componentType":5123,"count":2)",
       "accessor 1 ends within a triangle, at /accessors/1/count of its JSON"},
      {R"({"mesh":0})", R"({"mesh":0,"translation":[0,1000001,0]})",
       "mesh 0 has a position that is not a number from -1000000 to 1000000, once it is moved, at "
       "/meshes/0/primitives/0 of its JSON"},
      {R"({"mesh":0})", R"({"mesh":0,"scale":[1e9,1e9,1e9],"children":[0]})",
       "mesh 0 has a position that is not a number from -1000000 to 1000000, once it is moved, at "
       "/meshes/0/primitives/0 of its JSON"},
      {R"(,"indices":1,"material":0)", R"(,"material":0)", ""},
      {R"("POSITION":0})", R"("POSITION":0,"NORMAL":7})",
       "mesh 0 refers to normals that do not exist, at /meshes/0/primitives/0/attributes/NORMAL of its JSON"},
      {R"("POSITION":0})", R"("POSITION":0,"TEXCOORD_0":-1})",
       "mesh 0 refers to texture coordinates that do not exist, at /meshes/0/primitives/0/attributes/TEXCOORD_0 of its "
       "JSON"},
      {R"("POSITION":0})", R"("POSITION":9})",
       "mesh 0 refers to positions that do not exist, at /meshes/0/primitives/0/attributes/POSITION of its JSON"},
      {R"("POSITION":0})", R"("POSITION":0,"NORMAL":1})",
       "accessor 1 is not of type VEC3, at /accessors/1/type of its JSON"},
      {R"("POSITION":0})", R"("POSITION":0,"TEXCOORD_0":0})",
       "accessor 0 is not of type VEC2, at /accessors/0/type of its JSON"},
      {R"("indices":1)", R"("indices":0)", "accessor 0 is not of type SCALAR, at /accessors/0/type of its JSON"},
      {R"("count":3,"type":"VEC3")", R"("byteOffset":-4,"count":3,"type":"VEC3")",
       "accessor 0 reaches beyond the end of its buffer view, at /accessors/0 of its JSON"},
      {R"("byteOffset":40,"byteLength":6)", R"("byteOffset":40,"byteLength":6,"byteStride":4)",
       "accessor 1 reaches beyond the end of its buffer view, at /accessors/1 of its JSON"},
      {R"("byteOffset":40,"byteLength":6)", R"("byteOffset":40,"byteLength":12,"byteStride":4)",
       "indices have a stride of their own, at /bufferViews/1/byteStride of its JSON"},
      {R"("type":"VEC3")", R"("type":"VEC2")", "accessor 0 is not of type VEC3, at /accessors/0/type of its JSON"},
      {R"("componentType":5126)", R"("componentType":5123)",
       "accessor 0 does not hold floats, and the file does not use KHR_mesh_quantization, at "
       "/accessors/0/componentType of its JSON"},
      {R"("componentType":5123)", R"("componentType":5122)",
       "accessor 1 does not hold unsigned whole numbers, at /accessors/1/componentType of its JSON"},
      {R"("count":3,"type":"VEC3")", R"("count":0,"type":"VEC3")",
       "accessor 0 holds nothing, at /accessors/0/count of its JSON"},
      {R"("count":3,"type":"VEC3")", R"("count":4,"type":"VEC3")",
       "accessor 0 reaches beyond the end of its buffer view, at /accessors/0 of its JSON"},
      {R"("count":3,"type":"VEC3")", R"("count":3,"byteOffset":9007199254740992,"type":"VEC3")",
       "accessor 0 reaches beyond the end of its buffer view, at /accessors/0 of its JSON"},
      {R"("count":3,"type":"VEC3")", R"("count":3,"sparse":{},"type":"VEC3")",
       "accessor 0 replaces none of its elements, or more than it has, at /accessors/0/sparse/count of its JSON"},
      {R"("bufferView":0,)", R"("bufferView":9,)",
       "accessor 0 has no buffer view, at /accessors/0/bufferView of its JSON"},
      {R"("buffer":0,"byteOffset":0)", R"("buffer":1,"byteOffset":0)",
       "buffer view 0 refers to a buffer that does not exist, at /bufferViews/0/buffer of its JSON"},
      {R"("buffers":[{)", R"("buffers":[{"uri":"file:///a.bin",)",
       "buffer 0 lies in another file, `file:///a.bin`, at /buffers/0 of its JSON"},
      {R"("byteLength":36)", R"("byteLength":9007199254740992)",
       "buffer view 0 reaches beyond the end of its buffer, at /bufferViews/0 of its JSON"},
      {R"("byteLength":36)", R"("byteLength":36,"byteStride":8)",
       "buffer view 0 has a stride that its elements do not fit into, at /bufferViews/0/byteStride of its JSON"},
      {R"("byteLength":36)", R"("byteLength":36,"byteStride":24)",
       "accessor 0 reaches beyond the end of its buffer view, at /accessors/0 of its JSON"},
  };
  for (const Case& one : cases) {
    INFO(one.to);
    CHECK(refusal(triangleFile(one.from, one.to)) == one.message);
  }
  std::string nan = triangleFile();
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(nan.data() + nan.size() - 60, &not_a_number, 4);
  const std::string first_byte = std::to_string(nan.size() - 60);
  CHECK(refusal(nan) ==
        "accessor 0 has a position that is not a number from -1000000 to 1000000, at byte " + first_byte);
  std::string beyond = triangleFile();
  beyond[beyond.size() - 16] = 3;
  CHECK(refusal(beyond) == "accessor 1 has a corner that is not one of the primitive's 3 points, at byte " +
                               std::to_string(beyond.size() - 16));
}

TEST_CASE("what a file may ask for is capped", "[asset][glb]") {
  CHECK(refusal(triangleFile(), {.json_bytes = 10}) == "it has more than 10 bytes of JSON");
  CHECK(refusal(triangleFile(), {.points = 2}) == "it has more than 2 points");
  CHECK(refusal(triangleFile(), {.triangles = 0}) == "it has more than 0 triangles");
  CHECK(refusal(triangleFile(R"(,"indices":1)", ""), {.triangles = 0}) == "it has more than 0 triangles");
  CHECK(refusal(triangleFile(), {.nodes = 0}) == "it has more than 0 nodes");
}

TEST_CASE("normals and texture coordinates come as the nodes turn them", "[asset][glb]") {
  // Two primitives of one triangle each; only the first has normals, and texture coordinates as 16-bit numbers.
  const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, normals[9] = {1, 1, 0, 0, 0, 2, 0, 0, 0};
  const uint16_t places[6] = {0, 65535, 65535, 0, 0, 0};
  std::string binary(reinterpret_cast<const char*>(points), sizeof points);
  binary.append(reinterpret_cast<const char*>(normals), sizeof normals);
  binary.append(reinterpret_cast<const char*>(places), sizeof places);
  const auto file = [&](const std::string& how) {
    return glbOf(R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0)" + how +
                     R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}},)"
                     R"({"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}}]}],)"
                     R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                     R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"},)"
                     R"({"bufferView":0,"byteOffset":72,"componentType":5123,"normalized":true,"count":3,)"
                     R"("type":"VEC2"}],"bufferViews":[{"buffer":0,"byteLength":84}],"buffers":[{"byteLength":84}]})",
                 binary);
  };
  const auto near = [](const Normal& a, const Normal& b) {
    return std::fabs(a[0] - b[0]) + std::fabs(a[1] - b[1]) + std::fabs(a[2] - b[2]) < 1e-6f;
  };
  const auto mesh = read(file(R"(,"scale":[2,1,-1])"));
  REQUIRE(mesh);
  REQUIRE(mesh->normals.values.size() == 6);
  REQUIRE(mesh->coordinates.values.size() == 6);
  CHECK(mesh->normals.corners.empty());
  CHECK(mesh->normals.values[0] == Normal{});
  // Stretching the surface along x shrinks its normals along x; mirroring it along z mirrors its normals, too.
  CHECK(near(mesh->normals.values[3], unitNormal(0.5, 1, 0)));
  CHECK(near(mesh->normals.values[4], {0, 0, -1}));
  CHECK(mesh->normals.values[5] == Normal{});
  CHECK(mesh->triangles[1] == std::array<uint32_t, 3>{3, 5, 4});
  CHECK(near(mesh->normalAt(1, 2), {0, 0, -1}));
  CHECK(mesh->coordinatesAt(1, 0) == TextureCoordinates{0, 0});
  CHECK(mesh->coordinatesAt(1, 2) == TextureCoordinates{1, 1});
  CHECK(mesh->coordinatesAt(0, 2) == TextureCoordinates{});
  const auto wrongly = [&](const std::string& from, const std::string& to) {
    std::string changed = file("");
    const size_t at = changed.find(from);
    REQUIRE(at != std::string::npos);
    REQUIRE(from.size() == to.size());
    return refusal(changed.replace(at, from.size(), to));
  };
  CHECK(wrongly(R"("componentType":5123)", R"("componentType":5125)") ==
        "accessor 2 does not hold floats, or whole numbers that are normalized, at /accessors/2/componentType of its "
        "JSON");
  CHECK(wrongly(R"("byteOffset":36,"componentType":5126,"count":3)",
                R"("byteOffset":36,"componentType":5126,"count":2)") ==
        "accessor 1 does not hold as many elements as there are positions, at /accessors/1/count of its JSON");
  // A surface scaled to zero has no normals.
  CHECK(read(file(R"(,"scale":[0,0,0])"))->normals.values[4] == Normal{});
  binary[36] = binary[37] = binary[38] = binary[39] = '\xFF';
  const std::string nan = file("");
  CHECK(refusal(nan) == "accessor 1 has a normal that is not finite, at byte " + std::to_string(nan.size() - 48));
}

TEST_CASE("a small file that names much takes little time", "[asset][glb]") {
  // A file in which one accessor is a JSON object with many members, and is used by many primitives of many nodes.
  std::string members, primitives, nodes;
  for (int i = 0; i < 30000; ++i) members += "\"\":0,";
  for (int i = 0; i < 400; ++i) primitives += std::string(i > 0 ? "," : "") + R"({"attributes":{"POSITION":0}})";
  for (int i = 0; i < 2000; ++i) nodes += std::string(i > 0 ? "," : "") + R"({"mesh":0})";
  const std::string json = R"({"asset":{},"nodes":[)" + nodes + R"(],"meshes":[{"primitives":[)" + primitives +
                           R"(]}],"accessors":[{)" + members +
                           R"("bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
                           R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]})";
  const auto mesh = read(glbOf(json, triangleBytes()));
  REQUIRE(mesh);
  CHECK(mesh->triangles.size() == 800000);
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

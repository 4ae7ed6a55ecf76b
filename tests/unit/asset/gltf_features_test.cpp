// Tests every feature of glTF 2.0 that changes which triangles a static file shows (sections 3.6 and 3.7), and such
// extensions: with one file for each, made here, and expected values that were derived by hand.

#include <cmath>

#include "asset/read/glb_reader.h"
#include "catch.h"
#include "gltf_builder.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

TriangleMesh gltf(const std::string& file) {
  Result<TriangleMesh> mesh = readGlb(std::as_bytes(std::span(file)));
  INFO((mesh ? "" : mesh.error().message));
  REQUIRE(mesh);
  return std::move(*mesh);
}

std::string gltfRefusal(const std::string& file) {
  const Result<TriangleMesh> mesh = readGlb(std::as_bytes(std::span(file)));
  return mesh ? "" : mesh.error().message;
}

using Notes = std::vector<std::string>;

bool isNear(Point a, Point b) { return length(a - b) < 1e-6; }
bool isNear(const TextureCoordinates& a, float u, float v) {
  return std::fabs(a[0] - u) < 1e-6f && std::fabs(a[1] - v) < 1e-6f;
}

/// A cube with volume 8. more: further attributes, each with a comma in front; behind: further members of the
/// primitive.
GltfBuilder cube(const std::string& more = "", const std::string& behind = "", const std::string& of_mesh = "") {
  GltfBuilder file;
  file.numbers("VEC3", kCubePoints);
  file.numbers("SCALAR", kCubeIndices);
  file.mesh(R"("attributes":{"POSITION":0)" + more + R"(},"indices":1)" + behind, of_mesh);
  return file;
}

std::vector<float> eight(std::initializer_list<float> values) {
  std::vector<float> out;
  for (int i = 0; i < 8; ++i) out.insert(out.end(), values.begin(), values.end());
  return out;
}

}  // namespace

TEST_CASE("glTF: accessors are read by offset and stride, whatever lies between", "[asset][gltf]") {
  // Normals and positions interleaved, after four bytes of other data.
  std::vector<float> woven{99};
  for (size_t i = 0; i < 8; ++i) {
    woven.insert(woven.end(), {0, 0, 2});
    woven.insert(woven.end(), &kCubePoints[3 * i], &kCubePoints[3 * i] + 3);
  }
  GltfBuilder file;
  file.view(woven, R"(,"byteStride":24)");
  file.accessor("VEC3", 5126, 8, R"(,"bufferView":0,"byteOffset":16)");
  file.accessor("VEC3", 5126, 8, R"(,"bufferView":0,"byteOffset":4)");
  file.numbers("SCALAR", kCubeIndices);
  file.mesh(R"("attributes":{"POSITION":0,"NORMAL":1},"indices":2)");
  const TriangleMesh mesh = gltf(file.glb());
  CHECK(volumeOf(mesh) == 8);
  CHECK(openEdgesOf(mesh) == 0);
  CHECK(mesh.normals.values == std::vector<Normal>(8, Normal{0, 0, 1}));
  CHECK(mesh.notes.empty());
}

TEST_CASE("glTF: strips and fans of triangles", "[asset][gltf]") {
  // A tetrahedron of volume 1/6 as a triangle strip, and as a fan with an extra base triangle.
  const std::vector<float> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const auto with = [&](int mode, const std::vector<uint16_t>& indices, const std::string& node = "") {
    GltfBuilder file;
    file.members = R"("nodes":[{"mesh":0)" + node + "}]";
    file.numbers("VEC3", points);
    file.numbers("SCALAR", indices);
    file.mesh(R"("attributes":{"POSITION":0},"indices":1,"mode":)" + std::to_string(mode));
    return gltf(file.glb());
  };
  const TriangleMesh strip = with(5, {1, 0, 2, 3, 1, 0});
  CHECK(strip.triangles == std::vector<std::array<uint32_t, 3>>{{1, 0, 2}, {0, 3, 2}, {2, 3, 1}, {3, 0, 1}});
  CHECK(volumeOf(strip) == Approx(1.0 / 6));
  CHECK(openEdgesOf(strip) == 0);
  // Repeated corners connect two strips and make no triangles.
  const TriangleMesh led = with(5, {0, 2, 1, 1, 0, 0, 1, 3});
  CHECK(led.triangles == std::vector<std::array<uint32_t, 3>>{{0, 2, 1}, {0, 3, 1}});
  // Separate triangles joined into one strip, each at an odd position: their orientations are kept, and a note is
  // given.
  const TriangleMesh unruly = with(5, {0, 0, 2, 1, 1, 1, 0, 0, 1, 3, 3, 3, 1, 1, 2, 3, 3, 3, 2, 2, 0, 3});
  CHECK(volumeOf(unruly) == Approx(1.0 / 6));
  CHECK(unruly.notes == Notes{"1 strip has triangles at odd places only, at /meshes/0/primitives/0 of its JSON: read "
                              "without the reversal that the format requires"});
  CHECK(led.notes.empty());
  const TriangleMesh fan = with(6, {3, 0, 1, 2, 0});
  CHECK(fan.triangles == std::vector<std::array<uint32_t, 3>>{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  // In a mirrored node, the triangles still face outwards.
  const TriangleMesh mirrored = with(5, {1, 0, 2, 3, 1, 0}, R"(,"scale":[-1,1,1])");
  CHECK(volumeOf(mirrored) == Approx(1.0 / 6));
  // Without indices, the points are used in their order.
  GltfBuilder bare;
  bare.numbers("VEC3", std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  bare.mesh(R"("attributes":{"POSITION":0},"mode":6)");
  CHECK(gltf(bare.glb()).triangles == std::vector<std::array<uint32_t, 3>>{{1, 2, 0}, {2, 3, 0}});
  GltfBuilder few;
  few.numbers("VEC3", std::vector<float>{0, 0, 0, 1, 0, 0});
  few.mesh(R"("attributes":{"POSITION":0},"mode":5)");
  CHECK(gltfRefusal(few.glb()) ==
        "mesh 0 has a strip or a fan of fewer than three corners, at /meshes/0/primitives/0 of its JSON");
}

TEST_CASE("glTF: lines and points beside triangles are left out with a note", "[asset][gltf]") {
  for (const int mode : {0, 1, 2, 3}) {
    GltfBuilder file;
    file.numbers("VEC3", kCubePoints);
    file.numbers("SCALAR", kCubeIndices);
    const std::string own = R"("attributes":{"POSITION":0},"indices":1)";
    file.mesh(own + R"(},{)" + own + R"(,"mode":)" + std::to_string(mode));
    const TriangleMesh mesh = gltf(file.glb());
    CHECK(volumeOf(mesh) == 8);
    CHECK(mesh.notes == Notes{"1 primitive of lines or points is left out, at /meshes/0/primitives/1 of its JSON"});
  }
  GltfBuilder alone;
  alone.numbers("VEC3", kCubePoints);
  alone.mesh(R"("attributes":{"POSITION":0},"mode":0},{"attributes":{}},{"attributes":{"POSITION":0},"mode":3)");
  CHECK(
      gltfRefusal(alone.glb()) ==
      "it shows no triangles: 2 primitives of lines or points are left out, the first at /meshes/0/primitives/0 of its "
      "JSON: 1 primitive has no positions and is left out, at /meshes/0/primitives/1 of its JSON");
}

TEST_CASE("glTF: sparse accessors replace some of their numbers", "[asset][gltf]") {
  // One corner rises by 3, which changes three of the pyramids from the middle to the faces. Calculated by hand: 8 + 4
  // = 12.
  const auto with = [](auto index, const std::string& of) {
    GltfBuilder file;
    const int base = file.view(kCubePoints), indices = file.view(std::vector{index, static_cast<decltype(index)>(7)});
    const int values = file.view(std::vector<float>{1, 1, 2, -1, 1, 2});
    file.accessor("VEC3", 5126, 8,
                  (of.empty() ? R"(,"bufferView":)" + std::to_string(base) : of) +
                      R"(,"sparse":{"count":2,"indices":{)" + R"("bufferView":)" + std::to_string(indices) +
                      R"(,"componentType":)" + std::to_string(kComponent<decltype(index)>) +
                      R"(},"values":{"bufferView":)" + std::to_string(values) + "}}");
    file.numbers("SCALAR", kCubeIndices);
    file.mesh(R"("attributes":{"POSITION":0},"indices":1)");
    return file.glb();
  };
  // The edge y = 1 of the top rises from z = 1 to z = 2: a wedge of 2 x 2 x 1 / 2 is added.
  CHECK(volumeOf(gltf(with(uint8_t{6}, ""))) == 10);
  CHECK(volumeOf(gltf(with(uint16_t{6}, ""))) == 10);
  CHECK(volumeOf(gltf(with(uint32_t{6}, ""))) == 10);
  // Without a buffer view, all elements that are not in the sparse list are 0.
  const TriangleMesh zero = gltf(with(uint16_t{6}, " "));
  CHECK(zero.points[0] == Point{});
  CHECK(zero.points[6] == Point{1, 1, 2});
  CHECK(gltfRefusal(with(uint16_t{8}, "")) ==
        "accessor 0 replaces an element that it does not have, at /accessors/0/sparse/indices of its JSON");
  // Indices may be sparse, too: here, the last triangle is reversed.
  GltfBuilder file;
  file.numbers("VEC3", kCubePoints);
  std::vector<uint16_t> turned = kCubeIndices;
  std::swap(turned[34], turned[35]);
  file.view(turned);
  file.view(std::vector<uint8_t>{34, 35});
  file.view(std::vector<uint16_t>{4, 7});
  file.accessor("SCALAR", 5123, 36,
                R"(,"bufferView":1,"sparse":{"count":2,"indices":{"bufferView":2,"componentType":5121},)"
                R"("values":{"bufferView":3}})");
  file.mesh(R"("attributes":{"POSITION":0},"indices":1)");
  CHECK(openEdgesOf(gltf(file.glb())) == 0);
}

TEST_CASE("glTF: morph targets stand as their default weights say", "[asset][gltf]") {
  // The first target lifts the top by 1, adding 2 x 2 x 1. The second moves all points by 5 along x.
  const auto with = [](const std::string& of_mesh, const std::string& of_node) {
    GltfBuilder file = cube(R"(,"NORMAL":4,"TEXCOORD_0":5)",
                            R"(,"targets":[{"POSITION":2,"NORMAL":6},{"POSITION":3,"TEXCOORD_0":7}])", of_mesh);
    std::vector<float> lift(24, 0.0f);
    for (size_t i = 4; i < 8; ++i) lift[3 * i + 2] = 1;
    file.numbers("VEC3", lift);
    file.numbers("VEC3", eight({5, 0, 0}));
    file.numbers("VEC3", eight({0, 0, 1}));
    file.numbers("VEC2", eight({0.25f, 0.5f}));
    file.numbers("VEC3", eight({0, 1, -1}));
    file.numbers("VEC2", eight({0.5f, 0.25f}));
    file.members = R"("nodes":[{"mesh":0)" + of_node + "}]";
    return gltf(file.glb());
  };
  const TriangleMesh still = with("", "");
  CHECK(volumeOf(still) == 8);
  CHECK(still.normals.values[0] == Normal{0, 0, 1});
  const TriangleMesh lifted = with(R"(,"weights":[1,0])", "");
  CHECK(volumeOf(lifted) == 12);
  CHECK(lifted.normals.values[0] == Normal{0, 1, 0});
  CHECK(isNear(lifted.coordinates.values[0], 0.25f, 0.5f));
  const TriangleMesh moved = with(R"(,"weights":[1,0])", R"(,"weights":[0.5,2])");
  CHECK(volumeOf(moved) == Approx(10));
  CHECK(isNear(middleOf(moved), {10, 0, 0.25}));
  CHECK(isNear(moved.coordinates.values[0], 1.25f, 0));
  // If there are fewer weights than targets, the missing ones are 0.
  CHECK(volumeOf(with("", R"(,"weights":[-1])")) == 4);
}

TEST_CASE("glTF: morph targets may be sparse", "[asset][gltf]") {
  GltfBuilder file = cube("", R"(,"targets":[{"POSITION":2}])", R"(,"weights":[2])");
  const int indices = file.view(std::vector<uint16_t>{4, 5, 6, 7});
  const int values = file.view(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  file.accessor("VEC3", 5126, 8,
                R"(,"sparse":{"count":4,"indices":{"bufferView":)" + std::to_string(indices) +
                    R"(,"componentType":5123},"values":{"bufferView":)" + std::to_string(values) + "}}");
  CHECK(volumeOf(gltf(file.glb())) == 16);
}

TEST_CASE("glTF: skins hold points at the joints' places, whatever their node does", "[asset][gltf]") {
  // The mesh node's scale of 10 is ignored for a skinned mesh; the joint is at x = 100 below a rotated parent.
  const auto with = [](const std::string& nodes, const std::string& skin, const std::vector<uint8_t>& joints,
                       const auto& weights, const std::vector<float>& inverse = {}) {
    GltfBuilder file = cube(R"(,"JOINTS_0":2,"WEIGHTS_0":3)");
    file.numbers("VEC4", joints);
    using Weight = typename std::decay_t<decltype(weights)>::value_type;
    file.numbers("VEC4", weights, std::is_same_v<Weight, float> ? "" : R"(,"normalized":true)");
    if (!inverse.empty()) file.numbers("MAT4", inverse);
    file.members = R"("scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"skin":0,"scale":[10,10,10]},)" + nodes +
                   R"(],"skins":[{)" + skin + "}]";
    return gltf(file.glb());
  };
  const std::vector<uint8_t> first(32, 0);
  const std::vector<float> whole = eight({1, 0, 0, 0});
  const TriangleMesh bound = with(R"({"translation":[100,0,0]})", R"("joints":[1],"inverseBindMatrices":4)", first,
                                  whole, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 3, 1});
  CHECK(volumeOf(bound) == Approx(8));
  CHECK(isNear(middleOf(bound), {100, 0, 3}));
  // Without inverse bind matrices, these are the identity; joints may be children of other joints.
  const TriangleMesh below =
      with(R"({"children":[2],"rotation":[0,0,0.7071067811865476,0.7071067811865476]},{"translation":[100,0,0]})",
           R"("joints":[2])", first, whole);
  CHECK(isNear(middleOf(below), {0, 100, 0}));
  // Vertices are bound to two joints with weights, here of bytes: the upper half of the cube partly to the second
  // joint.
  const std::string two = R"({"translation":[0,0,0]},{"translation":[0,0,10]})";
  std::vector<uint8_t> numbers(32, 0), weights(32, 0);
  for (size_t i = 0; i < 8; ++i) {
    numbers[4 * i] = 1;
    weights[4 * i] = i < 4 ? 0 : 51;
    weights[4 * i + 1] = i < 4 ? 255 : 204;
  }
  const TriangleMesh bent = with(two, R"("joints":[1,2])", numbers, weights);
  CHECK(bent.notes.empty());
  // The top, z = 1, goes up by 10 * 51 / 255 = 2.
  CHECK(isNear(bent.points[6], {1, 1, 3}));
  CHECK(volumeOf(bent) == Approx(16));
  // A mirroring joint also reverses the triangles.
  CHECK(volumeOf(with(R"({"scale":[-1,1,1]})", R"("joints":[1])", first, whole)) == Approx(8));
  // Weights whose sum is not 1 are divided by it, with a note.
  const TriangleMesh doubled = with(R"({"translation":[4,0,0]})", R"("joints":[1])", first, eight({2, 0, 0, 0}));
  CHECK(isNear(middleOf(doubled), {4, 0, 0}));
  CHECK(doubled.notes ==
        Notes{"8 points have weights of joints that do not sum to 1, the first at /skins/0 of its JSON: "
              "divided by their sum"});
}

TEST_CASE("glTF: skins bind by several sets of joints, and turn normals", "[asset][gltf]") {
  GltfBuilder file = cube(R"(,"NORMAL":2,"JOINTS_0":3,"WEIGHTS_0":4,"JOINTS_1":5,"WEIGHTS_1":6)");
  file.numbers("VEC3", eight({1, 0, 0}));
  file.numbers("VEC4", std::vector<uint8_t>(32, 0));
  file.numbers("VEC4", eight({0.25f, 0, 0, 0}));
  file.numbers("VEC4", std::vector<uint16_t>(32, 1));
  file.numbers("VEC4", eight({0.5f, 0.25f, 0, 0}));
  const std::string turned = R"("rotation":[0,0,0.7071067811865476,0.7071067811865476])";
  file.members = R"("nodes":[{"mesh":0,"skin":0},{"translation":[8,0,0],)" + turned + R"(},{"translation":[0,4,0],)" +
                 turned + R"(}],"skins":[{"joints":[1,2]}])";
  const TriangleMesh mesh = gltf(file.glb());
  CHECK(isNear(middleOf(mesh), {2, 3, 0}));
  CHECK(volumeOf(mesh) == Approx(8));
  CHECK(std::fabs(mesh.normals.values[0][1] - 1) < 1e-6f);
}

TEST_CASE("glTF: what is wrong with a skin is said", "[asset][gltf]") {
  const auto with = [](const std::string& node, const std::string& skins, uint8_t joint = 0) {
    GltfBuilder file = cube(R"(,"JOINTS_0":2,"WEIGHTS_0":3)");
    file.numbers("VEC4", std::vector<uint8_t>(32, joint));
    file.numbers("VEC4", eight({1, 0, 0, 0}));
    file.numbers("MAT4", std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2});
    file.members = R"("nodes":[{"mesh":0,"skin":0},)" + node + R"(],"skins":[)" + skins + "]";
    return gltfRefusal(file.glb());
  };
  CHECK(with("{}", "") == "node 0 refers to a skin that does not exist, at /nodes/0/skin of its JSON");
  CHECK(with("{}", "{}") == "skin 0 has no joints, at /skins/0 of its JSON");
  CHECK(with("{}", R"({"joints":[2]})") ==
        "skin 0 refers to a joint that does not exist, at /skins/0/joints of its JSON");
  CHECK(with("{}", R"({"joints":[1,1],"inverseBindMatrices":4})") ==
        "accessor 4 holds fewer matrices than the skin has joints, at /accessors/4/count of its JSON");
  CHECK(with("{}", R"({"joints":[1],"inverseBindMatrices":4})") ==
        "skin 0 has a matrix whose last row is not 0, 0, 0, 1, at /skins/0/inverseBindMatrices of its JSON");
  CHECK(with("{}", R"({"joints":[1],"inverseBindMatrices":9})") ==
        "skin 0 refers to matrices that do not exist, at /skins/0/inverseBindMatrices of its JSON");
  CHECK(with("{}", R"({"joints":[1]})", 1) ==
        "accessor 2 binds point 0 to a joint that skin 0 does not have, at /accessors/2 of its JSON");
  CHECK(with(R"({"children":[1]})", R"({"joints":[1]})").ends_with("below itself, at /nodes/1 of its JSON"));
  // A mesh whose skin is unusable is moved by its node instead.
  GltfBuilder loose = cube();
  loose.members = R"("nodes":[{"mesh":0,"skin":0,"translation":[1,0,0]}],"skins":[{"joints":[0]}])";
  const TriangleMesh mesh = gltf(loose.glb());
  CHECK(isNear(middleOf(mesh), {1, 0, 0}));
  CHECK(mesh.notes == Notes{"1 primitive has a skin and no joints or weights, at /meshes/0/primitives/0 of its JSON: "
                            "moved by the node"});
}

TEST_CASE("glTF: textures are laid as the material says", "[asset][gltf]") {
  const auto with = [](const std::string& material, const std::string& sets = R"("TEXCOORD_0":1,"TEXCOORD_1":2)") {
    GltfBuilder file;
    file.numbers("VEC3", std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
    file.numbers("VEC2", std::vector<float>{0, 0, 1, 0, 0, 1});
    file.numbers("VEC2", std::vector<float>{0, 0, 3, 0, 0, 3});
    file.mesh(R"("attributes":{"POSITION":0,)" + sets + R"(},"material":0)");
    file.members = R"("nodes":[{"mesh":0}],"materials":[{)" + material + "}]";
    return gltf(file.glb());
  };
  const auto base = [](const std::string& info) {
    return R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0)" + info + "}}";
  };
  const auto laid = [&](const std::string& how, const std::string& set = "") {
    return base(set + R"(,"extensions":{"KHR_texture_transform":{)" + how + "}}");
  };
  // In glTF, v grows downwards in a picture; here, it grows upwards.
  CHECK(isNear(with("").coordinates.values[1], 1, 1));
  CHECK(isNear(with(base(R"(,"texCoord":1)")).coordinates.values[1], 3, 1));
  CHECK(isNear(with(R"("emissiveTexture":{"index":0,"texCoord":1})").coordinates.values[1], 3, 1));
  CHECK(isNear(with(base("") + R"(,"normalTexture":{"index":0,"texCoord":1})").coordinates.values[1], 1, 1));
  CHECK(isNear(with(laid(R"("scale":[4,2])")).coordinates.values[1], 4, 1));
  CHECK(isNear(with(laid(R"("scale":[4,2])")).coordinates.values[2], 0, -1));
  CHECK(isNear(with(laid(R"("offset":[0.5,0.25])")).coordinates.values[1], 1.5f, 0.75f));
  // A rotation by a quarter, counter-clockwise as seen: the right becomes the top, where v is smaller in glTF.
  CHECK(
      isNear(with(laid(R"("rotation":1.5707963267948966,"offset":[0,1],"scale":[2,1])")).coordinates.values[1], 0, 2));
  CHECK(isNear(with(laid(R"("rotation":1.5707963267948966)")).coordinates.values[2], 1, 1));
  CHECK(isNear(with(laid(R"("texCoord":1)", R"(,"texCoord":0)")).coordinates.values[1], 3, 1));
  const TriangleMesh without = with(base(R"(,"texCoord":1)"), R"("TEXCOORD_0":1)");
  CHECK(without.coordinates.empty());
  CHECK(without.notes == Notes{"1 primitive lacks the texture coordinates that its material names, at "
                               "/meshes/0/primitives/0 of its JSON: read without them"});
  GltfBuilder wrong = cube();
  wrong.members = R"("nodes":[{"mesh":0}],"materials":[{)" + laid(R"("scale":[1])") + "}]";
  CHECK(gltfRefusal(wrong.glb()) ==
        "a texture transform has values that are not numbers, or a wrong count of them, at "
        "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform of its JSON");
}

TEST_CASE("glTF: whole numbers stand for positions, normals and coordinates", "[asset][gltf]") {
  const auto with = [](auto one, bool normalized, const std::string& used, double half) {
    using T = decltype(one);
    GltfBuilder file;
    std::vector<T> points, normals;
    for (size_t i = 0; i < 8; ++i)
      for (size_t k = 0; k < 4; ++k) {
        // The fourth number is padding: vertex attributes are aligned to four bytes.
        const bool up = k < 3 && kCubePoints[3 * i + k] > 0;
        points.push_back(up ? one : static_cast<T>(std::is_signed_v<T> ? -one : 0));
        normals.push_back(k == 0 ? one : T{});
      }
    const std::string norm = normalized ? R"(,"normalized":true)" : "";
    const std::string stride = R"(,"byteStride":)" + std::to_string(4 * sizeof(T));
    const int at = file.view(points, stride), to = file.view(normals, stride);
    file.accessor("VEC3", kComponent<T>, 8, R"(,"bufferView":)" + std::to_string(at) + norm);
    file.numbers("SCALAR", kCubeIndices);
    file.accessor("VEC3", kComponent<T>, 8, R"(,"bufferView":)" + std::to_string(to) + norm);
    file.accessor("VEC2", kComponent<T>, 8, R"(,"bufferView":)" + std::to_string(to) + norm);
    file.mesh(R"("attributes":{"POSITION":0,"NORMAL":2,"TEXCOORD_0":3},"indices":1)");
    const std::string scale = std::to_string(1 / half);
    file.members = R"("nodes":[{"mesh":0,"scale":[)" + scale + "," + scale + "," + scale + "]}]" + used;
    return file.glb();
  };
  const std::string used = R"(,"extensionsUsed":["KHR_mesh_quantization"])";
  const std::string required = used + R"(,"extensionsRequired":["KHR_mesh_quantization"])";
  CHECK(volumeOf(gltf(with(int8_t{100}, false, required, 100))) == Approx(8));
  CHECK(volumeOf(gltf(with(int8_t{127}, true, used, 1))) == Approx(8));
  CHECK(volumeOf(gltf(with(int16_t{5000}, false, required, 5000))) == Approx(8));
  CHECK(volumeOf(gltf(with(int16_t{32767}, true, required, 1))) == Approx(8));
  CHECK(volumeOf(gltf(with(uint8_t{200}, false, required, 200))) == Approx(1));
  CHECK(volumeOf(gltf(with(uint8_t{255}, true, required, 1))) == Approx(1));
  CHECK(volumeOf(gltf(with(uint16_t{40000}, false, required, 40000))) == Approx(1));
  CHECK(volumeOf(gltf(with(uint16_t{65535}, true, required, 1))) == Approx(1));
  const TriangleMesh mesh = gltf(with(int16_t{32767}, true, required, 1));
  CHECK(mesh.normals.values[0] == Normal{1, 0, 0});
  CHECK(isNear(mesh.coordinates.values[0], 1, 1));
  // The smallest number (-128) means -1, too.
  GltfBuilder least;
  least.numbers("VEC3", std::vector<int8_t>{-128, 0, 0, 127, 0, 0, 0, 127, 0}, R"(,"normalized":true)");
  least.mesh(R"("attributes":{"POSITION":0})");
  least.members = R"("nodes":[{"mesh":0}])" + required;
  CHECK(gltf(least.glb()).points == std::vector<Point>{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(gltfRefusal(with(int16_t{5000}, false, "", 5000)) ==
        "accessor 0 does not hold floats, and the file does not use KHR_mesh_quantization, at "
        "/accessors/0/componentType of its JSON");
}

TEST_CASE("glTF: instances stand where their attributes say, and hidden nodes nowhere", "[asset][gltf]") {
  GltfBuilder file = cube();
  file.numbers("VEC3", std::vector<float>{0, 0, 0, 10, 0, 0});
  file.numbers("VEC3", std::vector<float>{1, 1, 1, 2, 2, 2});
  file.numbers("VEC4", std::vector<int8_t>{0, 0, 0, 127, 0, 0, 127, 0}, R"(,"normalized":true)");
  file.members =
      R"("nodes":[{"mesh":0,"scale":[1,1,2],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":2,)"
      R"("SCALE":3,"ROTATION":4,"_ID":1}}}}],"extensionsRequired":["EXT_mesh_gpu_instancing"])";
  const TriangleMesh twice = gltf(file.glb());
  CHECK(volumeOf(twice) == Approx(16 + 128));
  CHECK(isNear(middleOf(twice), {5, 0, 0}));
  // The second instance is rotated by half a turn about z: its first corner is where the third one was.
  CHECK(isNear(twice.points[8], {12, 2, -4}));
  GltfBuilder uneven = cube();
  uneven.numbers("VEC3", std::vector<float>{0, 0, 0, 10, 0, 0});
  uneven.numbers("VEC3", std::vector<float>{1, 1, 1});
  uneven.members = R"("nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":2,)"
                   R"("SCALE":3}}}}])";
  CHECK(gltfRefusal(uneven.glb()) ==
        "node 0 has instances of different numbers, at /nodes/0/extensions/EXT_mesh_gpu_instancing/attributes of its "
        "JSON");
  GltfBuilder hidden = cube();
  hidden.members =
      R"("scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"extensions":{"KHR_node_visibility":{"visible":true}}},)"
      R"({"children":[2],"extensions":{"KHR_node_visibility":{"visible":false}}},{"mesh":0}])";
  const TriangleMesh once = gltf(hidden.glb());
  CHECK(volumeOf(once) == 8);
  CHECK(once.notes == Notes{"1 node is hidden, with all below it, at /nodes/1 of its JSON: left out"});
}

TEST_CASE("glTF: the scene that the file names is read, with nodes however deep", "[asset][gltf]") {
  GltfBuilder two = cube();
  two.members =
      R"("scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}],"nodes":[{"mesh":0},{"mesh":0,"translation":[7,0,0]}])";
  const TriangleMesh second = gltf(two.glb());
  CHECK(isNear(middleOf(second), {7, 0, 0}));
  CHECK(second.notes == Notes{"it has 2 scenes, and only scene 1 is read"});
  GltfBuilder deep = cube();
  std::string nodes;
  for (int i = 0; i < 300; ++i) nodes += R"({"translation":[1,0,0],"children":[)" + std::to_string(i + 1) + "]},";
  deep.members = R"("scenes":[{"nodes":[0]}],"nodes":[)" + nodes + R"({"mesh":0}])";
  CHECK(isNear(middleOf(gltf(deep.glb())), {300, 0, 0}));
  GltfBuilder skewed = cube();
  skewed.members = R"("nodes":[{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2]}])";
  CHECK(gltfRefusal(skewed.glb()) ==
        "node 0 is moved by a matrix whose last row is not 0, 0, 0, 1, at /nodes/0 of its JSON");
}

TEST_CASE("glTF: extensions that change no triangles are accepted, others refused or noted", "[asset][gltf]") {
  const auto with = [](const std::string& list, const std::string& name) {
    GltfBuilder file = cube();
    file.members = R"("nodes":[{"mesh":0}],")" + list + R"(":[")" + name + R"("])";
    return file.glb();
  };
  for (const char* harmless :
       {"KHR_materials_unlit", "KHR_materials_variants", "KHR_texture_basisu", "KHR_texture_transform",
        "KHR_lights_punctual", "EXT_texture_webp", "KHR_xmp_json_ld", "MSFT_texture_dds", "EXT_mesh_features"}) {
    CHECK(gltf(with("extensionsRequired", harmless)).notes.empty());
    CHECK(gltf(with("extensionsUsed", harmless)).notes.empty());
  }
  for (const std::string compressed : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "CESIUM_RTC"}) {
    CHECK(gltfRefusal(with("extensionsRequired", compressed)) ==
          "it needs the extension `" + compressed + "`, at /extensionsRequired of its JSON");
  }
  CHECK(gltf(with("extensionsUsed", "EXT_meshopt_compression")).notes.empty());
  CHECK(gltf(with("extensionsUsed", "ACME_displacement")).notes ==
        Notes{"1 extension that it uses is left out, `ACME_displacement`"});
  // Compressed data without an uncompressed fallback is an error, not a mesh of zeros.
  GltfBuilder packed;
  packed.accessor("VEC3", 5126, 8, "");
  packed.accessor("SCALAR", 5123, 36, "");
  packed.mesh(
      R"("attributes":{"POSITION":0},"indices":1,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0}})");
  CHECK(
      gltfRefusal(packed.glb()) ==
      "mesh 0 is compressed by the extension `KHR_draco_mesh_compression`, at /meshes/0/primitives/0/extensions of its "
      "JSON");
}

TEST_CASE("glTF: files that are not padded, and bytes behind the end, are read with a note", "[asset][gltf]") {
  const GltfBuilder file = cube();
  std::string json = file.json();
  while (json.size() % 4 != 2) json += ' ';
  const auto join = [&](const std::string& text, bool padded, const std::string& behind) {
    std::string body;
    putWord(body, static_cast<uint32_t>(text.size()));
    putWord(body, 0x4E4F534A);
    body += text;
    while (padded && body.size() % 4 != 0) body += ' ';
    putWord(body, static_cast<uint32_t>(file.binary().size()));
    putWord(body, 0x004E4942);
    body += file.binary();
    std::string out;
    putWord(out, 0x46546C67);
    putWord(out, 2);
    putWord(out, static_cast<uint32_t>(12 + body.size()));
    return out + body + behind;
  };
  const std::string length = std::to_string(json.size());
  for (const bool padded : {false, true}) {
    const TriangleMesh mesh = gltf(join(json, padded, ""));
    CHECK(volumeOf(mesh) == 8);
    CHECK(mesh.notes == Notes{"the length of a chunk is not a multiple of 4 (" + length + "), at byte 12"});
  }
  const std::string even = json + "  ";
  CHECK(gltf(join("\xEF\xBB\xBF" + json + "   ", true, "")).notes.empty());
  const std::string whole = join(even, true, "");
  CHECK(gltf(whole).notes.empty());
  const TriangleMesh behind = gltf(whole + "abc");
  CHECK(volumeOf(behind) == 8);
  CHECK(behind.notes == Notes{"3 bytes after its end are left out, at byte " + std::to_string(whole.size())});
  const TriangleMesh zeros = gltf(join(json + std::string(2, '\0'), true, ""));
  CHECK(zeros.notes == Notes{"its JSON is padded with zero bytes, not with blanks"});
}

TEST_CASE("glTF: text with its numbers in itself is read; other files are not opened", "[asset][gltf]") {
  const GltfBuilder file = cube();
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string coded;
  for (size_t i = 0; i < file.binary().size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < file.binary().size() ? static_cast<unsigned char>(file.binary()[i + k]) : 0u);
    for (unsigned k = 0; k < 4; ++k) coded += kDigits[bits >> (18 - 6 * k) & 63];
  }
  const auto uri = [](const std::string& text) { return R"(,"uri":")" + text + '"'; };
  CHECK(volumeOf(gltf(file.json(uri("data:application/octet-stream;base64," + coded)))) == 8);
  CHECK(volumeOf(gltf(file.json(uri("data:;base64," + coded)))) == 8);
  CHECK(gltfRefusal(file.json(uri("data:;base64,?"))) ==
        "buffer 0 has a `data:` URI that is not base64, at /buffers/0 of its JSON");
  CHECK(gltfRefusal(file.json(uri("cube.bin"))) ==
        "buffer 0 lies in another file, `cube.bin`, at /buffers/0 of its JSON");
  // The JSON may be long, but not hold many values, which take memory.
  std::string many = file.json(uri("data:;base64," + coded));
  many.insert(1, R"("extras":[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0],)");
  CHECK(volumeOf(gltf(many)) == 8);
  const auto capped = readGlb(std::as_bytes(std::span(many)), {.json_bytes = 100});
  REQUIRE(!capped);
  CHECK(capped.error().code == Code::limit);
  CHECK(capped.error().message == "it has more than 51 JSON values");
  CHECK(gltfRefusal(file.json()) == "buffer 0 has no bytes in the file, at /buffers/0 of its JSON");
}

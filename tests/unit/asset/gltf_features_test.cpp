// Tests every feature of glTF 2.0 that changes which triangles a static file shows (sections 3.6 and 3.7). Each test
// builds a file, and compares it with values that were calculated by hand.

#include "gltf_cubes.h"

using namespace sgm;
using namespace sgm::asset;

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
  // A tetrahedron of volume 1/6, once as a triangle strip, and once as a fan with an extra base triangle.
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
  // Repeated corners join two strips, and add no triangles.
  const TriangleMesh led = with(5, {0, 2, 1, 1, 0, 0, 1, 3});
  CHECK(led.triangles == std::vector<std::array<uint32_t, 3>>{{0, 2, 1}, {0, 3, 1}});
  // Separate triangles joined into one strip, each at an odd position, where the format reverses triangles: the reader
  // keeps their orientation, and adds a note.
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
  // A primitive without indices uses its points in the order in which they are stored.
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
  // Makes a cube whose sparse position accessor moves the corners `index` and 7 to (1, 1, 2) and (-1, 1, 2). of: JSON
  // members in place of the reference to the dense values.
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
  // The top's edge y = 1 rises from z = 1 to z = 2, which adds a wedge with the volume 2 x 2 x 1 / 2.
  CHECK(volumeOf(gltf(with(uint8_t{6}, ""))) == 10);
  CHECK(volumeOf(gltf(with(uint16_t{6}, ""))) == 10);
  CHECK(volumeOf(gltf(with(uint32_t{6}, ""))) == 10);
  // Without a buffer view, all elements that are not in the sparse list are 0.
  const TriangleMesh zero = gltf(with(uint16_t{6}, " "));
  CHECK(zero.points[0] == Point{});
  CHECK(zero.points[6] == Point{1, 1, 2});
  CHECK(gltfRefusal(with(uint16_t{8}, "")) ==
        "accessor 0 replaces an element that it does not have, at /accessors/0/sparse/indices of its JSON");
  // Indices may be sparse, too: here, the dense indices reverse the last triangle, and the sparse ones correct that.
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
  // The first morph target lifts the top by 1, which adds a volume of 2 x 2 x 1. The second moves all points by 5 along
  // x.
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
  // If a mesh has fewer weights than morph targets, the missing weights are 0.
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
  // In glTF, the texture coordinate v grows downwards in a picture; in a TriangleMesh, it grows upwards.
  CHECK(isNear(with("").coordinates.values[1], 1, 1));
  CHECK(isNear(with(base(R"(,"texCoord":1)")).coordinates.values[1], 3, 1));
  CHECK(isNear(with(R"("emissiveTexture":{"index":0,"texCoord":1})").coordinates.values[1], 3, 1));
  CHECK(isNear(with(base("") + R"(,"normalTexture":{"index":0,"texCoord":1})").coordinates.values[1], 1, 1));
  CHECK(isNear(with(laid(R"("scale":[4,2])")).coordinates.values[1], 4, 1));
  CHECK(isNear(with(laid(R"("scale":[4,2])")).coordinates.values[2], 0, -1));
  CHECK(isNear(with(laid(R"("offset":[0.5,0.25])")).coordinates.values[1], 1.5f, 0.75f));
  // A rotation of the picture by a quarter turn, counter-clockwise: its right side comes to the top, where v is smaller
  // in glTF.
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
        // The fourth number is padding, because vertex attributes are aligned to four bytes.
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
  // The smallest normalized 8-bit number, -128, also means -1.
  GltfBuilder least;
  least.numbers("VEC3", std::vector<int8_t>{-128, 0, 0, 127, 0, 0, 0, 127, 0}, R"(,"normalized":true)");
  least.mesh(R"("attributes":{"POSITION":0})");
  least.members = R"("nodes":[{"mesh":0}])" + required;
  CHECK(gltf(least.glb()).points == std::vector<Point>{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(gltfRefusal(with(int16_t{5000}, false, "", 5000)) ==
        "accessor 0 does not hold floats, and the file does not use KHR_mesh_quantization, at "
        "/accessors/0/componentType of its JSON");
}

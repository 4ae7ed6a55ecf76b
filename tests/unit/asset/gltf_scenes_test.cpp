// Tests the positions to which the skins, instances and scenes of glTF 2.0 move triangles; also its extensions and
// containers. Each test builds a file, and compares it with values that were calculated by hand.

#include "gltf_cubes.h"

using namespace sgm;
using namespace sgm::asset;

TEST_CASE("glTF: skins hold points at the joints' places, whatever their node does", "[asset][gltf]") {
  // Makes a cube that is bound to a skin. Its own node has a scale of 10, which must have no effect on skinned points.
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
  // Missing inverse bind matrices mean the identity. Here, the joint is the child of a rotated node.
  const TriangleMesh below =
      with(R"({"children":[2],"rotation":[0,0,0.7071067811865476,0.7071067811865476]},{"translation":[100,0,0]})",
           R"("joints":[2])", first, whole);
  CHECK(isNear(middleOf(below), {0, 100, 0}));
  // Points bound to two joints, with weights in bytes: for the upper half of the cube, the second joint has a weight of
  // 1/5.
  const std::string two = R"({"translation":[0,0,0]},{"translation":[0,0,10]})";
  std::vector<uint8_t> numbers(32, 0), weights(32, 0);
  for (size_t i = 0; i < 8; ++i) {
    numbers[4 * i] = 1;
    weights[4 * i] = i < 4 ? 0 : 51;
    weights[4 * i + 1] = i < 4 ? 255 : 204;
  }
  const TriangleMesh bent = with(two, R"("joints":[1,2])", numbers, weights);
  CHECK(bent.notes.empty());
  // The top, z = 1, moves up by 10 * 51 / 255 = 2.
  CHECK(isNear(bent.points[6], {1, 1, 3}));
  CHECK(volumeOf(bent) == Approx(16));
  // A joint that mirrors also reverses the triangles, so that they still face outwards.
  CHECK(volumeOf(with(R"({"scale":[-1,1,1]})", R"("joints":[1])", first, whole)) == Approx(8));
  // Weights whose sum is not 1 are divided by the sum, with a note.
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
  // A mesh without joints or weights cannot be bound to its skin, so its node moves it.
  GltfBuilder loose = cube();
  loose.members = R"("nodes":[{"mesh":0,"skin":0,"translation":[1,0,0]}],"skins":[{"joints":[0]}])";
  const TriangleMesh mesh = gltf(loose.glb());
  CHECK(isNear(middleOf(mesh), {1, 0, 0}));
  CHECK(mesh.notes == Notes{"1 primitive has a skin and no joints or weights, at /meshes/0/primitives/0 of its JSON: "
                            "moved by the node"});
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
  // Half a turn about z puts the first corner where the third one was.
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
  // Compressed data without uncompressed accessors must be refused, and not be read as zeros.
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
  // The JSON text may be long, for example because of a `data:` URI. json_bytes limits the number of its values,
  // because each value takes memory.
  std::string many = file.json(uri("data:;base64," + coded));
  many.insert(1, R"("extras":[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0],)");
  CHECK(volumeOf(gltf(many)) == 8);
  const auto capped = readGlb(std::as_bytes(std::span(many)), {.json_bytes = 100});
  REQUIRE(!capped);
  CHECK(capped.error().code == Code::limit);
  CHECK(capped.error().message == "it has more than 51 JSON values");
  CHECK(gltfRefusal(file.json()) == "buffer 0 has no bytes in the file, at /buffers/0 of its JSON");
}

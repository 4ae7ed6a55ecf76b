// Tests the messages of the mesh readers that no other test produces; each test builds its own file.

#include <limits>

#include "asset/read/polygon_cutter.h"
#include "catch.h"
#include "gltf_builder.h"
#include "mesh_bytes.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

using Notes = std::vector<std::string>;

constexpr float kInfinite = std::numeric_limits<float>::infinity();

Notes notesOf(const std::string& file, MeshFileKind kind = MeshFileKind::glb) { return meshIn(file, kind).notes; }
std::string glbRefusal(const std::string& file) { return refusalOf(file, MeshFileKind::glb); }

/// JSON members of a cube's primitive, for GltfBuilder::mesh(): accessor 0 has the cube's positions, accessor 1 its
/// indices.
std::string cubePrimitive(const std::string& more = "", const std::string& behind = "") {
  return R"("attributes":{"POSITION":0)" + more + R"(},"indices":1)" + behind;
}

/// A file with one mesh that has these primitives; accessors 0 and 1 have the data of a cube.
GltfBuilder cubesOf(const std::string& primitives = cubePrimitive()) {
  GltfBuilder file;
  file.numbers("VEC3", kCubePoints);
  file.numbers("SCALAR", kCubeIndices);
  file.mesh(primitives);
  return file;
}

/// The JSON of a primitive, `count` times (1 or 2), as elements of an array.
std::string times(int count, const std::string& primitive) {
  return count == 1 ? primitive : primitive + "},{" + primitive;
}

/// Four numbers for each of the eight corners of a cube: `first`, 0, 0, 0.
std::vector<float> fourEach(float first) {
  std::vector<float> out;
  for (int i = 0; i < 8; ++i) out.insert(out.end(), {first, 0, 0, 0});
  return out;
}

/// A cube that is bound to a skin with one joint; weights: four for each corner.
GltfBuilder boundCube(const std::vector<float>& weights, const std::string& joint = "{}",
                      const std::string& of_skin = "") {
  GltfBuilder file = cubesOf(cubePrimitive(R"(,"JOINTS_0":2,"WEIGHTS_0":3)"));
  file.numbers("VEC4", std::vector<uint8_t>(32, 0));
  file.numbers("VEC4", weights);
  file.members = R"("nodes":[{"mesh":0,"skin":0},)" + joint + R"(],"skins":[{"joints":[1])" + of_skin + "}]";
  return file;
}

/// A cube with GPU instances. attributes: JSON of the instances' attributes, which refer to accessors 2 and above.
GltfBuilder placedCube(const std::string& attributes) {
  GltfBuilder file = cubesOf();
  file.members = R"("nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{)" + attributes + "}}}}]";
  return file;
}

}  // namespace

TEST_CASE("other files that are no meshes are called by their names", "[asset][messages]") {
  using namespace std::string_literals;
  const std::pair<std::string, std::string> cases[] = {
      {"\xFF\xD8\xFF\xE0\0\x10JFIF"s, "it is a JPEG picture, not a mesh"},
      {"GIF89a\1\0\1\0"s, "it is a GIF picture, not a mesh"},
      {"%PDF-1.7\n", "it is a PDF document, not a mesh"},
      {"\x1F\x8B\x08\0\0\0\0\0"s, "it is compressed by gzip, not a mesh file by itself"},
      {"\x28\xB5\x2F\xFD\x04\x20",
       "it is compressed by Zstandard (as new .blend files are), not a mesh file by itself"},
      {"7z\xBC\xAF\x27\x1C", "it is a 7z archive, not a mesh file by itself"},
      {"Rar!\x1A\x07\x01", "it is a RAR archive, not a mesh file by itself"},
      {"BLENDER-v300", "it is a Blender file, which sgm does not read"},
      {"PXR-USDC\0\x08"s, "it is a USD file, which sgm does not read"},
      {"#usda 1.0\ndef Xform \"World\"\n{\n}\n", "it is a USD file, which sgm does not read"},
      {"ISO-10303-21;\nHEADER;\n", "it is a STEP file, which sgm does not read"},
      {"#VRML V2.0 utf8\nShape { }\n", "it is a VRML file, which sgm does not read"},
      {"<COLLADA xmlns=\"x\">\n</COLLADA>\n", "it is a COLLADA file, which sgm does not read"},
  };
  for (const auto& [file, what] : cases)
    for (const MeshFileKind kind : {MeshFileKind::glb, MeshFileKind::obj, MeshFileKind::ply, MeshFileKind::stl})
      CHECK(refusalOf(file, kind) == what);
}

TEST_CASE("glTF: accessors of another type, and sparse ones without whole numbers, are refused", "[asset][gltf]") {
  GltfBuilder three = cubesOf(cubePrimitive(R"(,"JOINTS_0":2,"WEIGHTS_0":2)"));
  three.numbers("VEC3", std::vector<uint8_t>(24, 0));
  three.members = R"("nodes":[{"mesh":0,"skin":0},{}],"skins":[{"joints":[1]}])";
  CHECK(glbRefusal(three.glb()) == "accessor 2 is not of type VEC4, at /accessors/2/type of its JSON");
  const GltfBuilder vectors = boundCube(fourEach(1), "{}", R"(,"inverseBindMatrices":3)");
  CHECK(glbRefusal(vectors.glb()) == "accessor 3 is not of type MAT4, at /accessors/3/type of its JSON");
  GltfBuilder vast;
  vast.accessor("VEC3", 5126, (size_t{1} << 24) + 1, "");
  vast.mesh(R"("attributes":{"POSITION":0})");
  CHECK(glbRefusal(vast.glb()) ==
        "accessor 0 holds too many elements for one without a buffer view, at /accessors/0/count of its JSON");
  GltfBuilder sparse;
  sparse.view(std::vector<float>{0, 0, 0});
  sparse.accessor("VEC3", 5126, 3,
                  R"(,"sparse":{"count":1,"indices":{"bufferView":0,"componentType":5126},)"
                  R"("values":{"bufferView":0}})");
  sparse.mesh(R"("attributes":{"POSITION":0})");
  CHECK(glbRefusal(sparse.glb()) ==
        "accessor 0 has sparse indices that are not unsigned whole numbers, at "
        "/accessors/0/sparse/indices/componentType of its JSON");
}

TEST_CASE("glTF: numbers that are not finite are refused with their place", "[asset][gltf]") {
  // Byte offset of the last number in the file, which is the invalid one. The number begins `bytes` bytes before the
  // end of the file; padding follows it.
  const auto lastElement = [](const std::string& file, size_t bytes) { return std::to_string(file.size() - bytes); };
  std::vector<float> weights = fourEach(1);
  weights.back() = kInfinite;
  const std::string bound = boundCube(weights).glb();
  CHECK(glbRefusal(bound) == "accessor 3 has a number that is not finite, at byte " + lastElement(bound, 16));
  GltfBuilder placed = placedCube(R"("TRANSLATION":2)");
  placed.numbers("VEC3", std::vector<float>{0, 0, 0, 0, kInfinite, 0});
  CHECK(glbRefusal(placed.glb()) ==
        "accessor 2 has a number that is not finite, at byte " + lastElement(placed.glb(), 12));
  GltfBuilder inverse = boundCube(fourEach(1), "{}", R"(,"inverseBindMatrices":4)");
  inverse.numbers("MAT4", std::vector<float>(16, kInfinite));
  CHECK(glbRefusal(inverse.glb()) ==
        "accessor 4 has a number that is not finite, at byte " + lastElement(inverse.glb(), 64));
  // In a `data:` URI, a reported offset counts decoded bytes. The buffer has three points, and x of the second is NaN.
  GltfBuilder text;
  text.numbers("VEC3", std::vector<float>(9, 0.0f));
  text.mesh(R"("attributes":{"POSITION":0})");
  CHECK(glbRefusal(text.json(R"(,"uri":"data:;base64,AAAAAAAAAAAAAAAAAADAfwAAAAAAAAAAAAAAAAAAAAAAAAAA")")) ==
        "accessor 0 has a position that is not a number from -1000000 to 1000000, at byte 12 of buffer 0");
  GltfBuilder laid = cubesOf(cubePrimitive(R"(,"TEXCOORD_0":2)", R"(,"material":0)"));
  laid.numbers("VEC2", std::vector<float>(16, 3e38f));
  laid.members = R"("nodes":[{"mesh":0}],"materials":[{"emissiveTexture":{"index":0,"extensions":{)"
                 R"("KHR_texture_transform":{"scale":[10,10]}}}}])";
  CHECK(glbRefusal(laid.glb()) ==
        "mesh 0 has texture coordinates that are not finite, once they are transformed, at /meshes/0/primitives/0 of "
        "its JSON");
}

TEST_CASE("glTF: what is odd about primitives is noted, of one and of several", "[asset][gltf]") {
  const auto ofBoth = [](const std::string& one, const std::string& members) {
    Notes out;
    for (const int count : {1, 2}) {
      GltfBuilder file = cubesOf(cubePrimitive() + "},{" + times(count, one));
      file.numbers("SCALAR", std::vector<uint16_t>{0, 0, 2, 1, 1, 1, 0, 0, 1, 3});
      file.accessor("VEC3", 5126, 3, "");
      if (!members.empty()) file.members = members;
      for (const std::string& note : notesOf(file.glb())) out.push_back(note);
    }
    return out;
  };
  CHECK(ofBoth(R"("attributes":{})", "") ==
        Notes{"1 primitive has no positions and is left out, at /meshes/0/primitives/1 of its JSON",
              "2 primitives have no positions and are left out, the first at /meshes/0/primitives/1 of its JSON"});
  CHECK(ofBoth(R"("attributes":{"POSITION":0},"indices":2,"mode":5)", "") ==
        Notes{"1 strip has triangles at odd places only, at /meshes/0/primitives/1 of its JSON: read without the "
              "reversal that the format requires",
              "2 strips have triangles at odd places only, the first at /meshes/0/primitives/1 of its JSON: read "
              "without the reversal that the format requires"});
  CHECK(ofBoth(R"("attributes":{"POSITION":3})", "") ==
        Notes{"1 primitive has positions without bytes, at /meshes/0/primitives/1 of its JSON: all of them are 0",
              "2 primitives have positions without bytes, the first at /meshes/0/primitives/1 of its JSON: all of "
              "them are 0"});
  CHECK(ofBoth(cubePrimitive("", R"(,"material":0)"),
               R"("nodes":[{"mesh":0}],"materials":[{"emissiveTexture":{"index":0,"texCoord":1}}])") ==
        Notes{"1 primitive lacks the texture coordinates that its material names, at /meshes/0/primitives/1 of its "
              "JSON: read without them",
              "2 primitives lack the texture coordinates that their materials name, the first at "
              "/meshes/0/primitives/1 of its JSON: read without them"});
  GltfBuilder loose = cubesOf(times(2, cubePrimitive()));
  loose.members = R"("nodes":[{"mesh":0,"skin":0}],"skins":[{"joints":[0]}])";
  CHECK(notesOf(loose.glb()) ==
        Notes{"2 primitives have a skin and no joints or weights, the first at /meshes/0/primitives/0 of its JSON: "
              "moved by the node"});
}

TEST_CASE("glTF: what is odd about the file, its scene and its skins is said", "[asset][gltf]") {
  const std::string whole = cubesOf().glb();
  CHECK(notesOf(whole + "a") == Notes{"1 byte after its end is left out, at byte " + std::to_string(whole.size())});
  GltfBuilder extended = cubesOf();
  extended.members = R"("nodes":[{"mesh":0}],"extensionsUsed":["ACME_one","ACME_two"])";
  CHECK(notesOf(extended.glb()) == Notes{"2 extensions that it uses are left out, the first `ACME_one`"});
  GltfBuilder hidden = cubesOf();
  const std::string out_of_sight = R"({"mesh":0,"extensions":{"KHR_node_visibility":{"visible":false}}})";
  hidden.members = R"("nodes":[{"mesh":0},)" + out_of_sight + "," + out_of_sight + "]";
  CHECK(notesOf(hidden.glb()) ==
        Notes{"2 nodes are hidden, with all below them, the first at /nodes/1 of its JSON: left out"});
  const std::string behind = ", at /nodes/0/extensions/EXT_mesh_gpu_instancing/attributes of its JSON";
  CHECK(glbRefusal(placedCube(R"("TRANSLATION":2)").glb()) == "node 0 refers to instances that do not exist" + behind);
  GltfBuilder placed = placedCube(R"("ROTATION":2)");
  placed.numbers("VEC4", std::vector<float>{0, 0, 0, 1, 0, 0, 0, 0});
  CHECK(glbRefusal(placed.glb()) == "node 0 has an instance turned by a quaternion without a length" + behind);
  CHECK(glbRefusal(boundCube(fourEach(1), R"({"children":[1]})").glb()) ==
        "node 1 stands below itself, at /nodes/1 of its JSON");
  std::vector<float> weights = fourEach(1);
  weights[0] = 0.5f;
  CHECK(notesOf(boundCube(weights).glb()) ==
        Notes{"1 point has weights of joints that do not sum to 1, at /skins/0 of its JSON: divided by their sum"});
}

TEST_CASE("OBJ: several of what is left out are noted as one", "[asset][obj]") {
  CHECK(notesOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ncurv 0 1 1 2\nsurf 0 1 0 1 1 2 3\ncall a.obj\ncsh ls\n"
                "fancy 1\nfancier 2\n",
                MeshFileKind::obj) ==
        Notes{"2 curves and surfaces are left out, the first at line 5: save it as polygons to have them",
              "2 calls of other files or commands are left out, the first at line 7",
              "2 lines begin with words that OBJ does not have and are left out, the first at line 9, `fancy`"});
}

TEST_CASE("PLY and STL: one byte behind the end, and several faces that are none, are noted", "[asset][ply][stl]") {
  const std::string vertices = "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n";
  const std::string corners = "property list uchar uchar vertex_indices\nend_header\n";
  CHECK(notesOf("ply\nformat ascii 1.0\n" + vertices + "element face 3\n" + corners +
                    "0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n1 2\n",
                MeshFileKind::ply) ==
        Notes{"2 faces have fewer than three corners and are left out, the first at line 13"});
  const std::string binary = "ply\nformat binary_little_endian 1.0\n" + vertices + "element face 1\n" + corners +
                             std::string("\0\0\0\1\0\0\0\1\0\3\0\1\2", 13);
  CHECK(notesOf(binary + "a", MeshFileKind::ply) ==
        Notes{"1 byte after its last element is left out, at byte " + std::to_string(binary.size())});
  std::string stl(80, '\0');
  putNumber(stl, uint32_t{1});
  for (const float v : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) putNumber(stl, v);
  putNumber(stl, uint16_t{0});
  CHECK(notesOf(stl, MeshFileKind::stl).empty());
  CHECK(notesOf(stl + "a", MeshFileKind::stl) ==
        Notes{"1 byte after its last triangle is left out, at byte " + std::to_string(stl.size())});
}

TEST_CASE("polygons that take more steps than there are are refused with their place", "[asset][polygon]") {
  // An L-shaped face: a triangle fan around its first corner would also cover points outside of the face.
  TriangleMesh mesh;
  mesh.points = {{2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}};
  for (uint32_t k = 2; k < 6; ++k) mesh.triangles.push_back({0, k - 1, k});
  const auto fan = mesh.triangles;
  const Result<void> refused = PolygonCutter(mesh, "line", 2).add(6, 7);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Code::limit);
  CHECK(refused.error().message ==
        "it has polygons too intricate to be cut into triangles, such as one of 6 corners, at line 7");
  CHECK(mesh.triangles == fan);
  CHECK(PolygonCutter(mesh, "line").add(6, 7));
  CHECK(mesh.triangles != fan);
}

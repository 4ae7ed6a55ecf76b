// Tests that exported meshes are read back unchanged in every format, and that damaged files do no harm.

#include "asset/read/mesh_file.h"

#include <algorithm>
#include <random>

#include "asset/read/glb_reader.h"
#include "catch.h"
#include "mesh/export/export.h"
#include "mesh/vertex.h"
#include "mesh_bytes.h"
#include "rounds.h"
#include "temporary_folder.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

/// Random triangles, which form no closed surface. Their coordinates are floats, so that no format loses precision.
WorldMesh randomWorldMesh(std::mt19937& random) {
  WorldMesh mesh;
  const size_t points = 3 + random() % 60, triangles = 1 + random() % 120;
  const auto number = [&] { return static_cast<double>(static_cast<float>(random()) / 65536.0f - 32768.0f); };
  for (size_t i = 0; i < points; ++i) {
    mesh.positions.push_back({number(), number(), number()});
    const auto packed = [&] { return static_cast<int16_t>(static_cast<int>(random() % 65535) - 32767); };
    mesh.attributes.push_back({packed(), packed(), static_cast<uint16_t>(random() % 3), 0});
  }
  for (size_t i = 0; i < 3 * triangles; ++i) mesh.indices.push_back(static_cast<uint32_t>(random() % points));
  return mesh;
}

std::string exported(const WorldMesh& mesh, const ExportInfo& info, const std::string& kind) {
  const TemporaryFolder folder;
  const auto path = folder.path / ("mesh." + kind);
  REQUIRE(exportMesh(mesh, info, path));
  return contentOf(path);
}

/// Rounds each coordinate to the nearest float, which is what the exporters write.
Point roundedToFloat(Point p) {
  for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<double>(static_cast<float>(p[axis]));
  return p;
}

Point pointAt(const WorldMesh& mesh, uint32_t index) {
  const auto& p = mesh.positions[index];
  return {p[0], p[1], p[2]};
}

/// The order of triangles in an exported file: sorted by material, if the format has materials.
std::vector<size_t> exportedOrder(const WorldMesh& mesh, bool by_material) {
  std::vector<size_t> order;
  const auto material = [&](size_t t) {
    const auto at = [&](size_t k) { return mesh.attributes[mesh.indices[3 * t + k]].material; };
    return at(1) == at(2) ? at(1) : at(0);
  };
  for (size_t t = 0; t < mesh.indices.size() / 3; ++t) order.push_back(t);
  if (by_material)
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return material(a) < material(b); });
  return order;
}

const char* const kKinds[] = {"glb", "obj", "ply", "stl"};

}  // namespace

TEST_CASE("what is exported reads back as it was", "[asset][mesh_file]") {
  ExportInfo info;
  info.materials.resize(3);
  for (size_t i = 0; i < 3; ++i) info.materials[i].name = "stone_" + std::to_string(i);
  for (unsigned seed = 0; seed < rounds(60); ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const WorldMesh mesh = randomWorldMesh(random);
    for (const std::string kind : kKinds) {
      INFO(kind);
      const std::string file = exported(mesh, info, kind);
      REQUIRE(meshFileKind("a/b." + kind));
      const TriangleMesh read = meshIn(file, *meshFileKind("a/b." + kind));
      CHECK(meshFileKind(bytesOf(file)) == *meshFileKind("a/b." + kind));
      const bool materials = kind == "glb" || kind == "obj";
      const std::vector<size_t> order = exportedOrder(mesh, materials);
      REQUIRE(read.triangles.size() == order.size());
      REQUIRE(read.materials.size() == order.size());
      REQUIRE(read.normals.empty() == (kind == "stl"));
      double error = 0;
      bool same = true;
      for (size_t t = 0; t < order.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
          const uint32_t corner = mesh.indices[3 * order[t] + k];
          same = same && roundedToFloat(read.points[read.triangles[t][k]]) == pointAt(mesh, corner);
          if (kind == "obj" || kind == "ply") same = same && read.triangles[t][k] == corner;
          if (kind == "stl") continue;
          const auto n = unpackNormal(mesh.attributes[corner].normal_x, mesh.attributes[corner].normal_y);
          const Normal& m = read.normalAt(t, k);
          for (size_t axis = 0; axis < 3; ++axis) error = std::max(error, std::fabs(n[axis] - double{m[axis]}));
        }
        if (materials) {
          const uint32_t corner = mesh.indices[3 * order[t]];
          const auto material = [&](size_t c) { return mesh.attributes[mesh.indices[3 * order[t] + c]].material; };
          const uint16_t expected = material(1) == material(2) ? material(1) : mesh.attributes[corner].material;
          same = same && read.material_names[read.materials[t]] == info.materials[expected].name;
        } else {
          same = same && read.materials[t] == kNoMaterial;
        }
      }
      CHECK(same);
      CHECK(error < 2e-7);
    }
  }
}

TEST_CASE("texture coordinates that are exported read back, with points that stay what they were",
          "[asset][mesh_file]") {
  // Two triangles that share an edge, in two charts: four points with six different texture coordinates.
  WorldMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.attributes.resize(4);
  mesh.indices = {0, 1, 2, 0, 2, 3};
  const uint32_t vertices[] = {0, 1, 2, 0, 2, 3}, corners[] = {0, 1, 2, 3, 4, 5};
  const std::array<float, 2> places[] = {{0, 0}, {0.5f, 0}, {0.5f, 1}, {2, 0.25f}, {3, 1}, {2, 1}};
  const ExportBlend blends[6] = {};
  const ExportTexture texture{vertices, places, blends, corners, {}};
  ExportInfo info;
  info.texture = &texture;
  const TriangleMesh obj = meshIn(exported(mesh, info, "obj"), MeshFileKind::obj);
  const TriangleMesh glb = meshIn(exported(mesh, info, "glb"), MeshFileKind::glb);
  CHECK(obj.points.size() == 4);
  CHECK(obj.normals.corners.empty());
  CHECK(obj.coordinates.corners.size() == 2);
  CHECK(glb.points.size() == 6);
  for (size_t i = 0; i < 6; ++i) {
    CHECK(obj.coordinatesAt(i / 3, i % 3) == places[i]);
    // The texture coordinate v has the opposite direction in glTF; because pictures repeat, v and v + 1 mean the same
    // place.
    CHECK(glb.coordinatesAt(i / 3, i % 3) == TextureCoordinates{places[i][0], places[i][1] + 1});
  }
}

TEST_CASE("a file's kind is told by its name or by its beginning", "[asset][mesh_file]") {
  CHECK(*meshFileKind("a.b/House.GLB") == MeshFileKind::glb);
  CHECK(*meshFileKind("x.gltf") == MeshFileKind::glb);
  CHECK(*meshFileKind("x.obj") == MeshFileKind::obj);
  CHECK(*meshFileKind("x.Ply") == MeshFileKind::ply);
  CHECK(*meshFileKind(".stl") == MeshFileKind::stl);
  for (const char* path : {"x.usd", "glb", "", "a.obj/b", "x.obj.zip"}) {
    const auto kind = meshFileKind(path);
    REQUIRE(!kind);
    CHECK(kind.error().message ==
          std::string(path) + ": the mesh format is unsupported; use .glb, .gltf, .obj, .ply or .stl");
  }
  const auto of = [](const std::string& bytes) { return meshFileKind(bytesOf(bytes)); };
  CHECK(of("glTF") == MeshFileKind::glb);
  CHECK(of("ply\r\n") == MeshFileKind::ply);
  CHECK(of("solid x\n") == MeshFileKind::stl);
  CHECK(of("# comment\n\nmtllib a.mtl\n") == MeshFileKind::obj);
  CHECK(of(std::string(84, '\0')) == MeshFileKind::stl);
  CHECK(of(" {\"asset\":{}}") == MeshFileKind::glb);
  for (const char* bytes : {"", "\n#", "{\"assets\":{}}", "PK\x03\x04", "volume", "plywood\n"})
    CHECK(of(bytes) == std::nullopt);
}

TEST_CASE("a file whose name tells nothing is read by its bytes", "[asset][mesh_file]") {
  const auto mesh = readMesh(bytesOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), std::nullopt);
  REQUIRE(mesh);
  CHECK(mesh->triangles.size() == 1);
  CHECK(mesh->notes == std::vector<std::string>{"by its bytes it is OBJ, and is read as such"});
  CHECK(readMesh(bytesOf("?"), std::nullopt).error().message ==
        "the mesh format is unsupported; use .glb, .gltf, .obj, .ply or .stl");
  CHECK(readMesh(bytesOf("ply\n"), std::nullopt).error().message.ends_with(meshFileAdvice(MeshFileKind::ply)));
}

TEST_CASE("what is refused says what to do", "[asset][mesh_file]") {
  const std::string none = "?";
  const auto message = [&](MeshFileKind kind) { return readMesh(bytesOf(none), kind).error().message; };
  CHECK(message(MeshFileKind::glb) ==
        "it is not a GLB file: it does not begin with `glTF`; save it as binary glTF 2.0 (.glb), all in one file, as "
        "triangles, uncompressed");
  CHECK(message(MeshFileKind::obj) ==
        "`?` is not a keyword of an OBJ file, at line 1; save it again as Wavefront OBJ, with its faces as `f` lines");
  CHECK(message(MeshFileKind::ply) ==
        "it is not a PLY file: it does not begin with `ply`, at line 1; save it again as PLY 1.0, with the elements "
        "`vertex` and `face`");
  CHECK(message(MeshFileKind::stl) ==
        "it is not an STL file: it ends within its header, at byte 1; save it again as binary STL");
  CHECK(message(static_cast<MeshFileKind>(9)) == "there is no such kind of mesh file");
  CHECK(readMesh(bytesOf("v 0 0 0\n"), MeshFileKind::obj, {.points = 0}).error().message ==
        "it has more than 0 points; simplify it, or split it into several files");
}

TEST_CASE("no damage to a mesh file does any harm", "[asset][mesh_file]") {
  std::mt19937 random(5);
  const WorldMesh mesh = randomWorldMesh(random);
  for (const std::string kind : kKinds) {
    const std::string good = exported(mesh, {}, kind);
    for (unsigned round = 0; round < rounds(1000); ++round) {
      std::string bytes = good.substr(0, random() % 8 == 0 ? random() % good.size() : good.size());
      for (size_t k = 0; k < random() % 4 && !bytes.empty(); ++k)
        bytes[random() % bytes.size()] = static_cast<char>(random() % 2 == 0 ? random() : '0' + random() % 10);
      const auto read = readMesh(bytesOf(bytes), *meshFileKind("x." + kind), {.triangles = 1000});
      if (!read) {
        CHECK(!read.error().message.empty());
        continue;
      }
      CHECK(read->materials.size() == read->triangles.size());
      bool within = true;
      for (const auto& t : read->triangles)
        for (const uint32_t corner : t) within = within && corner < read->points.size();
      CHECK(within);
    }
  }
}

namespace {

const std::string kTetrahedronObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

/// Encodes ASCII text in units of `width` bytes each. mark: begins with a byte order mark.
std::string widened(const std::string& text, size_t width, bool big_endian, bool mark) {
  std::string out;
  const auto put = [&](uint32_t code) {
    for (size_t k = 0; k < width; ++k) out += static_cast<char>(code >> 8 * (big_endian ? width - 1 - k : k) & 0xFF);
  };
  if (mark) put(0xFEFF);
  for (const char c : text) put(static_cast<unsigned char>(c));
  return out;
}

}  // namespace

TEST_CASE("text is read in every encoding", "[asset][mesh_file]") {
  const std::string stl =
      "solid s\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid s\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
      "3 0 1 2\n";
  const std::string
      obj = "# house\n" + kTetrahedronObj,
      gltf =
          R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
          R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,)"
          R"("byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:;base64,)" +
          std::string(48, 'A') + R"("}]})";
  for (const auto& [text, kind] : {std::pair{stl, MeshFileKind::stl}, std::pair{ply, MeshFileKind::ply},
                                   std::pair{obj, MeshFileKind::obj}, std::pair{gltf, MeshFileKind::glb}}) {
    const size_t triangles = meshIn(text, kind).triangles.size();
    CHECK(meshIn("\xEF\xBB\xBF" + text, kind).triangles.size() == triangles);
    for (const size_t width : {size_t{2}, size_t{4}})
      for (const bool big_endian : {false, true})
        for (const bool mark : {false, true}) {
          const TriangleMesh mesh = meshIn(widened(text, width, big_endian, mark), kind);
          CHECK(mesh.triangles.size() == triangles);
          CHECK(mesh.notes.empty());
        }
  }
  // The name has letters beyond ASCII, one beyond the first 65,536 code points, and half a surrogate pair.
  std::string named = widened("usemtl ", 2, false, true);
  for (const char16_t c : std::u16string(u"B\u00E4ume \U0001F332\xD800")) {
    named += static_cast<char>(c & 0xFF);
    named += static_cast<char>(c >> 8);
  }
  named += widened("\n" + kTetrahedronObj, 2, false, false);
  CHECK(meshIn(named, MeshFileKind::obj).material_names ==
        std::vector<std::string>{"B\xC3\xA4ume \xF0\x9F\x8C\xB2\xEF\xBF\xBD"});
}

TEST_CASE("a file is what its bytes are, whatever its name says", "[asset][mesh_file]") {
  std::mt19937 random(7);
  const WorldMesh mesh = randomWorldMesh(random);
  constexpr const char* kTitles[] = {"glTF", "OBJ", "PLY", "STL"};
  for (size_t is = 0; is < 4; ++is) {
    const std::string file = exported(mesh, {}, kKinds[is]);
    const size_t triangles = meshIn(file, static_cast<MeshFileKind>(is)).triangles.size();
    for (size_t named = 0; named < 4; ++named) {
      const TriangleMesh read = meshIn(file, static_cast<MeshFileKind>(named));
      CHECK(read.triangles.size() == triangles);
      CHECK(read.in_metres == (is == 0));
      if (named == is)
        CHECK(read.notes.empty());
      else
        CHECK(read.notes ==
              std::vector<std::string>{std::string("by its bytes it is ") + kTitles[is] + ", not " + kTitles[named] +
                                       " as its name or type says, and is read as such"});
    }
  }
}

TEST_CASE("what is no mesh is called by its name", "[asset][mesh_file]") {
  using namespace std::string_literals;
  const std::pair<std::string, std::string> cases[] = {
      {"\x89PNG\r\n\x1A\n", "it is a PNG picture, not a mesh"},
      {"PK\x03\x04....", "it is a ZIP archive (such as .zip, .3mf or .usdz), not a mesh file by itself"},
      {"Kaydara FBX Binary  \0\x1A\0"s, "it is an FBX file, which sgm does not read"},
      {"<?xml version=\"1.0\"?>\n<COLLADA>", "it is an XML file (such as COLLADA or X3D), which sgm does not read"},
      {"<!DOCTYPE html>\n<html>", "it is a web page, not a mesh"},
      {"sgm 1;\nunits m;\n", "it is a grammar (.sgm), not a mesh file"},
      {"OFF\n8 6 0\n", "it is an OFF file, which sgm does not read"},
      {"version https://git-lfs.github.com/spec/v1\n",
       "it is a Git LFS pointer, not the file itself: run `git lfs pull`"},
      {"", "it is empty"},
  };
  for (const auto& [file, what] : cases)
    for (const MeshFileKind kind : {MeshFileKind::glb, MeshFileKind::obj, MeshFileKind::ply, MeshFileKind::stl})
      CHECK(refusalOf(file, kind) == what);
}

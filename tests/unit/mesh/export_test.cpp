// Tests that written files are read back as the same mesh, and that failures leave no files.

#include "mesh/export/export.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "catch.h"
#include "fields.h"
#include "mesh/check.h"
#include "mesh/vertex.h"
#include "temporary_folder.h"

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#include <unistd.h>
#include <csignal>
#endif

using namespace sgm;
using namespace sgm::test;
namespace fs = std::filesystem;

namespace {

struct Folder : TemporaryFolder {
  size_t files() const { return static_cast<size_t>(std::distance(fs::directory_iterator(path), {})); }
};

template <class T>
T valueAt(const std::string& bytes, size_t offset) {
  T value;
  REQUIRE(offset + sizeof value <= bytes.size());
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// A bumpy ball with three materials; the table of materials lacks one of them.
WorldMesh someMesh(int32_t radius = 11) {
  const ChunkGrid grid{{-2048, 1024, 512}, 256, 0};
  const ChunkSamples samples = sampleChunk(
      [&](Int3 p, int) {
        const double d =
            std::sqrt((p.x - 16) * (p.x - 16) + (p.y - 16) * (p.y - 16) + (p.z - 16) * (p.z - 16)) - radius;
        return static_cast<int32_t>(std::floor(d * 1024)) + static_cast<int32_t>(pointHash(1, p) % 512);
      },
      latticeChunk({}, 0));
  MeshPart part;
  polygonizeBody(samples, grid, part);
  for (size_t i = 0; i < part.vertices.size(); ++i) {
    Vertex& v = part.vertices[i];
    v.material = v.y < 3000 ? 0 : v.y < 5000 ? 2 : 5;
    v.tag = static_cast<uint16_t>(i % 7);
    v.normal_x = static_cast<int16_t>(hashCombine(1, i) % 65535 - 32767);
    v.normal_y = static_cast<int16_t>(hashCombine(2, i) % 65535 - 32767);
  }
  const PlacedPart parts[] = {{&part, grid, 0}};
  return *weld(parts, {-1024, 0, 0});
}

ExportInfo someInfo() {
  ExportInfo info;
  info.name = "ball \"quoted\" \xC3\xA9 \xFF\n";
  info.generator = "test of export";
  info.materials = {{"rock", {0.5f, 0.4f, 0.3f}, 0.8f}, {"unused"}, {"wet rock", {0.1f, 0.2f, 0.3f}, 0.2f}};
  info.tags = {"none", "floor"};
  return info;
}

using Point = std::array<float, 3>;
using Corner3 = std::array<Point, 3>;

/// The triangles by corner positions, each beginning with its lowest corner: every format must preserve this set.
std::multiset<Corner3> trianglesOf(const WorldMesh& mesh) {
  std::multiset<Corner3> triangles;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    Corner3 t;
    for (size_t k = 0; k < 3; ++k)
      for (size_t axis = 0; axis < 3; ++axis)
        t[k][axis] = static_cast<float>(mesh.positions[mesh.indices[i + k]][axis]);
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.insert(t);
  }
  return triangles;
}

void addTriangle(std::multiset<Corner3>& triangles, Corner3 t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  triangles.insert(t);
}

}  // namespace

TEST_CASE("GLB blends pairs of materials by the colours of vertices", "[mesh][export]") {
  const Folder folder;
  const WorldMesh mesh = someMesh();
  // Half of the triangles are of rock only, the others blend from rock to wet rock.
  std::vector<uint32_t> vertices, corners;
  std::vector<std::array<float, 2>> coordinates;
  std::vector<ExportBlend> blends;
  const auto shareOf = [&](uint32_t vertex) { return static_cast<uint8_t>(vertex * 37 % 256); };
  std::map<std::pair<uint32_t, bool>, uint32_t> known;
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    const uint32_t vertex = mesh.indices[i];
    const bool pair = i / 3 >= mesh.indices.size() / 6;
    const auto [entry, is_new] = known.try_emplace({vertex, pair}, static_cast<uint32_t>(vertices.size()));
    if (is_new) {
      vertices.push_back(vertex);
      coordinates.push_back({static_cast<float>(vertex), 0.5f});
      blends.push_back({{0, static_cast<uint16_t>(pair ? 2 : 0)}, pair ? shareOf(vertex) : uint8_t{0}, {1, 2, 252}});
    }
    corners.push_back(entry->second);
  }
  const ExportTexture texture{vertices, coordinates, blends, corners, {}};
  ExportInfo info = someInfo();
  info.texture = &texture;
  REQUIRE(exportMesh(mesh, info, folder.path / "ball.glb"));
  const std::string bytes = contentOf(folder.path / "ball.glb");
  const size_t json_bytes = valueAt<uint32_t>(bytes, 12);
  const nlohmann::json json = nlohmann::json::parse(bytes.substr(20, json_bytes));
  const size_t data = 20 + json_bytes + 8;
  REQUIRE(json["materials"].size() == 2);
  CHECK(json["materials"][0]["name"] == "rock");
  CHECK(json["materials"][1]["name"] == "rock + wet rock");
  CHECK(!json["materials"][0].contains("extras"));
  CHECK(json["materials"][1]["extras"]["sgm"]["materials"] == nlohmann::json({"rock", "wet rock"}));
  CHECK(json["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"] == nlohmann::json({1, 1, 1, 1}));
  CHECK(json["materials"][1]["pbrMetallicRoughness"]["roughnessFactor"].get<double>() == Approx(0.5));
  const nlohmann::json& primitives = json["meshes"][0]["primitives"];
  REQUIRE(primitives.size() == 2);
  CHECK(!primitives[0]["attributes"].contains("COLOR_0"));
  size_t triangles = 0, coloured = 0;
  for (const nlohmann::json& primitive : primitives) {
    const auto placeOf = [&](const char* name, size_t i) {
      const nlohmann::json& accessor = json["accessors"][primitive["attributes"][name].get<size_t>()];
      const nlohmann::json& view = json["bufferViews"][accessor["bufferView"].get<size_t>()];
      return data + view["byteOffset"].get<size_t>() + accessor["byteOffset"].get<size_t>() +
             i * view["byteStride"].get<size_t>();
    };
    const nlohmann::json& positions = json["accessors"][primitive["attributes"]["POSITION"].get<size_t>()];
    triangles += json["accessors"][primitive["indices"].get<size_t>()]["count"].get<size_t>() / 3;
    for (size_t i = 0; i < positions["count"].get<size_t>(); ++i) {
      const auto vertex = static_cast<uint32_t>(valueAt<float>(bytes, placeOf("TEXCOORD_0", i)));
      for (size_t axis = 0; axis < 3; ++axis) {
        CHECK(valueAt<float>(bytes, placeOf("POSITION", i) + 4 * axis) ==
              static_cast<float>(mesh.positions[vertex][axis]));
      }
      const size_t blend = placeOf("_BLEND", i);
      CHECK(valueAt<uint8_t>(bytes, blend) == 1);
      CHECK(valueAt<uint8_t>(bytes, blend + 2) == 252);
      if (!primitive["attributes"].contains("COLOR_0")) continue;
      ++coloured;
      CHECK(valueAt<uint8_t>(bytes, blend + 3) == shareOf(vertex));
      for (size_t channel = 0; channel < 3; ++channel) {
        const double first = info.materials[0].colour[channel], second = info.materials[2].colour[channel];
        CHECK(valueAt<uint16_t>(bytes, placeOf("COLOR_0", i) + 2 * channel) / 65535.0 ==
              Approx(first + (second - first) * shareOf(vertex) / 255).margin(1e-4));
      }
    }
  }
  CHECK(triangles == mesh.indices.size() / 3);
  CHECK(coloured > 100);
}

TEST_CASE("GLB reads back", "[mesh][export]") {
  const Folder folder;
  const WorldMesh mesh = someMesh();
  REQUIRE(exportMesh(mesh, someInfo(), folder.path / "ball.glb"));
  CHECK(folder.files() == 1);
  const std::string bytes = contentOf(folder.path / "ball.glb");
  REQUIRE(bytes.substr(0, 4) == "glTF");
  CHECK(valueAt<uint32_t>(bytes, 4) == 2);
  CHECK(valueAt<uint32_t>(bytes, 8) == bytes.size());
  const size_t json_bytes = valueAt<uint32_t>(bytes, 12);
  CHECK(bytes.substr(16, 4) == "JSON");
  const nlohmann::json json = nlohmann::json::parse(bytes.substr(20, json_bytes));
  const size_t data = 20 + json_bytes + 8;
  CHECK(valueAt<uint32_t>(bytes, data - 8) == json["buffers"][0]["byteLength"]);
  CHECK(data + json["buffers"][0]["byteLength"].get<size_t>() == bytes.size());
  CHECK(json["asset"]["generator"] == "test of export");
  CHECK(json["nodes"][0]["name"] == "ball \"quoted\" \xC3\xA9 ?\n");
  CHECK(json["scenes"][0]["extras"]["sgm"]["originUnits"] == nlohmann::json({-1024, 0, 0}));
  CHECK(json["scenes"][0]["extras"]["sgm"]["tags"][1] == "floor");
  CHECK(json["materials"].size() == 3);
  CHECK(json["materials"][1]["name"] == "wet rock");
  CHECK(json["materials"][2]["name"] == "material 5");

  const auto at = [&](const nlohmann::json& accessor, size_t element_bytes, size_t i) {
    const nlohmann::json& view = json["bufferViews"][accessor["bufferView"].get<size_t>()];
    return data + view.value("byteOffset", size_t{0}) + accessor.value("byteOffset", size_t{0}) +
           i * view.value("byteStride", element_bytes);
  };
  std::multiset<Corner3> triangles;
  std::map<Point, uint16_t> tag_of;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto& p = mesh.positions[i];
    tag_of[{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}] = mesh.attributes[i].tag;
  }
  for (const nlohmann::json& primitive : json["meshes"][0]["primitives"]) {
    const nlohmann::json& positions = json["accessors"][primitive["attributes"]["POSITION"].get<size_t>()];
    const nlohmann::json& normals = json["accessors"][primitive["attributes"]["NORMAL"].get<size_t>()];
    const nlohmann::json& tags = json["accessors"][primitive["attributes"]["_TAG"].get<size_t>()];
    const nlohmann::json& indices = json["accessors"][primitive["indices"].get<size_t>()];
    REQUIRE(indices["componentType"] == 5123);
    Point low{1e9f, 1e9f, 1e9f}, high{-1e9f, -1e9f, -1e9f};
    for (size_t i = 0; i < positions["count"]; ++i) {
      const auto p = valueAt<Point>(bytes, at(positions, 12, i)), n = valueAt<Point>(bytes, at(normals, 12, i));
      for (size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
      CHECK(std::abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-5f);
      CHECK(valueAt<uint16_t>(bytes, at(tags, 2, i)) == tag_of.at(p));
    }
    CHECK(positions["min"].get<Point>() == low);
    CHECK(positions["max"].get<Point>() == high);
    for (size_t i = 0; i < indices["count"]; i += 3) {
      Corner3 t;
      for (size_t k = 0; k < 3; ++k)
        t[k] = valueAt<Point>(bytes, at(positions, 12, valueAt<uint16_t>(bytes, at(indices, 2, i + k))));
      addTriangle(triangles, t);
    }
  }
  CHECK((triangles == trianglesOf(mesh)));
}

TEST_CASE("PLY and STL read back", "[mesh][export]") {
  const Folder folder;
  const WorldMesh mesh = someMesh();
  REQUIRE(exportMesh(mesh, someInfo(), folder.path / "ball.PLY"));
  const std::string ply = contentOf(folder.path / "ball.PLY");
  const std::string end_mark = "end_header\n";
  const size_t body = ply.find(end_mark) + end_mark.size();
  CHECK(ply.find("element vertex " + std::to_string(mesh.positions.size())) != std::string::npos);
  CHECK(ply.find("comment origin_units -1024 0 0 of 1/1024 m\n") != std::string::npos);
  CHECK(ply.find("comment tag 1 floor\n") != std::string::npos);
  constexpr size_t kVertex = 24 + 3 + 4;
  const size_t faces = body + mesh.positions.size() * kVertex;
  REQUIRE(ply.size() == faces + mesh.indices.size() / 3 * 13);
  std::multiset<Corner3> triangles;
  for (size_t f = 0; f < mesh.indices.size() / 3; ++f) {
    Corner3 t;
    REQUIRE(ply[faces + f * 13] == 3);
    for (size_t k = 0; k < 3; ++k)
      t[k] = valueAt<Point>(ply, body + kVertex * valueAt<uint32_t>(ply, faces + f * 13 + 1 + 4 * k));
    addTriangle(triangles, t);
  }
  CHECK((triangles == trianglesOf(mesh)));
  CHECK(valueAt<uint16_t>(ply, body + kVertex * 20 + 27) == mesh.attributes[20].material);
  CHECK(valueAt<uint16_t>(ply, body + kVertex * 20 + 29) == mesh.attributes[20].tag);

  REQUIRE(exportMesh(mesh, someInfo(), folder.path / "ball.stl"));
  const std::string stl = contentOf(folder.path / "ball.stl");
  REQUIRE(stl.size() == 84 + mesh.indices.size() / 3 * 50);
  CHECK(stl.substr(0, 5) != "solid");
  CHECK(valueAt<uint32_t>(stl, 80) == mesh.indices.size() / 3);
  triangles.clear();
  for (size_t f = 0; f < mesh.indices.size() / 3; ++f) addTriangle(triangles, valueAt<Corner3>(stl, 84 + f * 50 + 12));
  CHECK((triangles == trianglesOf(mesh)));
  CHECK(folder.files() == 2);
}

TEST_CASE("OBJ reads back, with its materials", "[mesh][export]") {
  const Folder folder;
  const WorldMesh mesh = someMesh();
  REQUIRE(exportMesh(mesh, someInfo(), folder.path / "ball.obj"));
  CHECK(folder.files() == 2);
  std::vector<Point> points, normals;
  std::multiset<Corner3> triangles;
  std::set<std::string> used, defined;
  std::istringstream in(contentOf(folder.path / "ball.obj"));
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "v" || keyword == "vn") {
      Point p;
      words >> p[0] >> p[1] >> p[2];
      (keyword == "v" ? points : normals).push_back(p);
    } else if (keyword == "usemtl") {
      used.insert(line.substr(7));
    } else if (keyword == "f") {
      Corner3 t;
      for (Point& corner : t) {
        std::string reference;
        words >> reference;
        const size_t number = std::stoul(reference);
        CHECK(reference == std::to_string(number) + "//" + std::to_string(number));
        corner = points.at(number - 1);
      }
      addTriangle(triangles, t);
    }
  }
  CHECK(points.size() == mesh.positions.size());
  CHECK(normals.size() == mesh.positions.size());
  CHECK((triangles == trianglesOf(mesh)));
  std::istringstream library(contentOf(folder.path / "ball.mtl"));
  for (std::string line; std::getline(library, line);)
    if (line.rfind("newmtl ", 0) == 0) defined.insert(line.substr(7));
  CHECK(used == std::set<std::string>{"rock", "wet_rock", "material_5"});
  CHECK(defined == used);
}

TEST_CASE("the materials of an .obj lie in a file whose name every reader finds", "[mesh][export]") {
  const Folder folder;
  const auto libraryOf = [&](const std::string& name) {
    const fs::path obj = folder.path / name;
    REQUIRE(exportMesh(WorldMesh(), {}, obj));
    const std::string text = contentOf(obj), keyword = "mtllib ";
    const size_t begin = text.find(keyword) + keyword.size();
    const std::string library = text.substr(begin, text.find('\n', begin) - begin);
    CHECK(fs::exists(folder.path / library));
    return library;
  };
  CHECK(libraryOf("a-house_2.5.obj") == "a-house_2.5.mtl");
  const std::string names[] = {"a house.obj", "a_house.obj", "a#house.obj", "\xC3\xA4 house.obj", "a  house.obj"};
  std::set<std::string> libraries;
  for (const std::string& name : names) {
    const std::string library = libraryOf(name);
    libraries.insert(library);
    CHECK(library.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_.") == std::string::npos);
  }
  CHECK(libraries.size() == std::size(names));
}

TEST_CASE("materials that others wrote stay, and .obj and .mtl change together or not at all", "[mesh][export]") {
  const Folder folder;
  const fs::path obj = folder.path / "ball.obj", mtl = folder.path / "ball.mtl";
  const WorldMesh mesh = someMesh();
  for (const char* foreign : {"# Blender 3.4.1 MTL File: 'ball.blend'\nnewmtl Skin\n", "newmtl a", "# x", "\n\n\n"}) {
    std::ofstream(mtl) << foreign;
    const Result<void> refused = exportMesh(mesh, someInfo(), obj);
    REQUIRE(!refused);
    CHECK(refused.error().code == Code::io);
    CHECK(refused.error().message.find("ball.mtl") != std::string::npos);
    CHECK(contentOf(mtl) == foreign);
    CHECK(folder.files() == 1);
  }
  std::ofstream(mtl, std::ios::trunc);
  REQUIRE(exportMesh(mesh, someInfo(), obj));
  const std::string before = contentOf(mtl);
  ExportInfo other = someInfo();
  other.materials[0].colour = {1, 0, 0};
  {
    Result<MeshFile> file = MeshFile::create(obj);
    REQUIRE(file);
    CHECK(file->paths() == std::vector<fs::path>{obj, mtl});
    REQUIRE(file->write(mesh, other));
    CHECK(file->bytes() == fs::file_size(obj) + fs::file_size(mtl));
  }
  const std::string after = contentOf(mtl);
  CHECK(after != before);
  // While the mesh is written, a folder with the name of the .obj file appears, so that writing fails: the old .mtl
  // file must be restored.
  for (const bool had_materials : {true, false}) {
    fs::remove_all(obj);
    if (!had_materials) fs::remove(mtl);
    Result<MeshFile> file = MeshFile::create(obj);
    REQUIRE(file);
    fs::create_directory(obj);
    CHECK(!file->write(mesh, someInfo()));
    CHECK(fs::exists(mtl) == had_materials);
    if (had_materials) CHECK(contentOf(mtl) == after);
  }
  CHECK(folder.files() == 1);
}

TEST_CASE("large primitives get 32-bit indices, empty meshes a valid file", "[mesh][export]") {
  const Folder folder;
  MeshPart part;
  const ChunkGrid grid = latticeChunk({}, 0);
  polygonizeBody(sampleChunk([](Int3 p, int) { return (p.x + p.y + p.z) % 2 == 0 ? -1 : 1; }, grid), grid, part);
  REQUIRE(part.vertices.size() > 65536);
  const PlacedPart parts[] = {{&part, grid, 0}};
  REQUIRE(exportMesh(*weld(parts, {}), {}, folder.path / "large.glb"));
  const std::string large = contentOf(folder.path / "large.glb");
  CHECK(large.find("\"componentType\":5125") != std::string::npos);
  for (const char* name : {"empty.glb", "empty.obj", "empty.ply", "empty.stl"})
    REQUIRE(exportMesh(WorldMesh{}, {}, folder.path / name));
  const std::string glb = contentOf(folder.path / "empty.glb");
  CHECK(valueAt<uint32_t>(glb, 8) == glb.size());
  CHECK(nlohmann::json::parse(glb.substr(20)).contains("asset"));
  CHECK(contentOf(folder.path / "empty.stl").size() == 84);
}

TEST_CASE("an export that fails leaves nothing behind and the old file as it was", "[mesh][export]") {
  const Folder folder;
  const WorldMesh mesh = someMesh();
  const Result<void> odd = exportMesh(mesh, {}, folder.path / "ball.xyz");
  REQUIRE(!odd);
  CHECK(odd.error().code == Code::invalid_argument);
  CHECK(odd.error().message.find(".glb, .obj, .ply or .stl") != std::string::npos);

  const Result<void> nowhere = exportMesh(mesh, {}, folder.path / "missing" / "ball.glb");
  REQUIRE(!nowhere);
  CHECK(nowhere.error().code == Code::io);
  CHECK(nowhere.error().message.find("No such file or directory") != std::string::npos);

  fs::create_directory(folder.path / "folder.glb");
  const Result<void> onto_folder = exportMesh(mesh, {}, folder.path / "folder.glb");
  REQUIRE(!onto_folder);
  CHECK(onto_folder.error().message.find("folder") != std::string::npos);
  CHECK(folder.files() == 1);
}

#if __has_include(<sys/resource.h>)
TEST_CASE("a full disk is one clear error, and nothing stays behind", "[mesh][export]") {
  const Folder folder;
  const WorldMesh mesh = someMesh();
  // Limits the size of files, so that a write fails as it does on a full disk.
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const char* name : {"ball.glb", "ball.obj", "ball.ply", "ball.stl"}) {
    std::ofstream(folder.path / name) << "old";
    rlimit small = before;
    small.rlim_cur = 20000;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
    const Result<void> result = exportMesh(mesh, {}, folder.path / name);
    REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
    INFO(name);
    REQUIRE(!result);
    CHECK(result.error().code == Code::io);
    CHECK(result.error().message.find(name) != std::string::npos);
    CHECK(result.error().message.find('\n') == std::string::npos);
    CHECK(contentOf(folder.path / name) == "old");
    fs::remove(folder.path / name);
    CHECK(folder.files() == 0);
  }
  std::signal(SIGXFSZ, old_handler);
}

TEST_CASE("a folder that may not be written to is one clear error", "[mesh][export]") {
  if (geteuid() == 0) {
    WARN("skipped: root may write everywhere");
    return;
  }
  const Folder folder;
  fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
  const Result<void> result = exportMesh(someMesh(), {}, folder.path / "ball.glb");
  fs::permissions(folder.path, fs::perms::owner_all);
  REQUIRE(!result);
  CHECK(result.error().code == Code::io);
  CHECK(result.error().message.find("Permission denied") != std::string::npos);
}
#endif

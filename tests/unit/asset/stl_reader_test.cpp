// Tests reading STL files as tools write them, and invalid ones.

#include "asset/read/stl_reader.h"

#include <limits>

#include "catch.h"
#include "mesh_bytes.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

/// A binary file with two triangles. count: the number of triangles that its header states.
std::string binaryStl(const std::string& header = "binary", uint32_t count = 2) {
  std::string out = header;
  out.resize(80, '\0');
  putNumber(out, count);
  for (int t = 0; t < 2; ++t) {
    for (const float v : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.5f}) putNumber(out, v);
    putNumber(out, uint16_t{0});
  }
  return out;
}

const std::string kStlFacet =
    "  facet normal nan 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n      vertex 0 1 5.0e-1\n"
    "    endloop\n  endfacet\n";
const std::string kStlText = "solid a ball\n" + kStlFacet + kStlFacet + "endsolid a ball\n";

std::string stlRefusal(const std::string& file, const MeshLimits& limits = {}) {
  return refusalOf(file, MeshFileKind::stl, limits);
}

std::string inCapitals(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

}  // namespace

TEST_CASE("an STL file's triangles have points of their own, binary and as text", "[asset][stl]") {
  for (const std::string& file :
       {binaryStl(), binaryStl("solid as text is, and yet binary"), kStlText, "\n " + inCapitals(kStlText),
        "solid\n" + kStlFacet + "endsolid\nsolid two\n" + kStlFacet + "endsolid two"}) {
    const TriangleMesh mesh = meshIn(file, MeshFileKind::stl);
    CHECK(mesh.triangles == std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {3, 4, 5}});
    CHECK(mesh.materials == std::vector<uint32_t>{kNoMaterial, kNoMaterial});
    REQUIRE(mesh.points.size() == 6);
    CHECK(mesh.points[1] == Point{1, 0, 0});
    CHECK(mesh.points[5] == Point{0, 1, 0.5});
    CHECK(mesh.normals.empty());
  }
}

TEST_CASE("what is wrong with an STL file is said with its line or its byte", "[asset][stl]") {
  const std::string size = std::to_string(binaryStl().size());
  const std::pair<std::string, std::string> cases[] = {
      {"", "it is empty"},
      {"facet", "it is not an STL file: it ends within its header, at byte 5"},
      {binaryStl("b", 3),
       "its header declares 3 triangles, which take 234 bytes, and the file has 184 bytes, at byte 80"},
      {binaryStl("solid", 4294967295u),
       "its header declares 4294967295 triangles, which take 214748364834 bytes, and the file has 184 bytes, at byte "
       "80"},
      {binaryStl("b", 0),
       "its header declares 0 triangles, which take 84 bytes, and the file has 184 bytes, at byte 80"},
      {binaryStl("b", 0).substr(0, 84), "it has no triangles"},
      {"solid\nendsolid\n", "it has no triangles"},
      {"solid\n", "it ends where `facet` is expected, at line 2"},
      {replacedIn(kStlText, "outer", "inner"), "`inner` stands where `outer` is expected, at line 3"},
      {replacedIn(kStlText, "loop", "lop"), "`lop` stands where `loop` is expected, at line 3"},
      {replacedIn(kStlText, "normal", "norm"), "`norm` stands where `normal` is expected, at line 2"},
      {replacedIn(kStlText, "endloop", "vertex 0 0 0"), "`vertex` stands where `endloop` is expected, at line 7"},
      {replacedIn(kStlText, "endfacet", "facet"), "`facet` stands where `endfacet` is expected, at line 8"},
      {replacedIn(kStlText, "  endfacet", ""), "`facet` stands where `endfacet` is expected, at line 9"},
      {replacedIn(kStlText, "vertex 1", "vertex a"), "`a` is not a number, at line 5"},
      {replacedIn(kStlText, "vertex 1", "vertex inf"),
       "a triangle has a corner that is not a number from -1000000 to 1000000, at line 5"},
      {kStlText.substr(0, kStlText.find("0 1 5")), "it ends within a triangle, at line 6"},
      {kStlText + "solids\n" + kStlFacet, "`solids` stands where `solid` is expected, at line 17"},
  };
  for (const auto& [file, message] : cases) {
    INFO(file);
    CHECK(stlRefusal(file) == message);
  }
  std::string nan = binaryStl();
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(nan.data() + 134 + 12 + 12 + 4, &not_a_number, 4);
  CHECK(stlRefusal(nan) == "a triangle has a corner that is not a number from -1000000 to 1000000, at byte 158");
  for (const std::string& file : {binaryStl(), kStlText}) {
    CHECK(stlRefusal(file, {.triangles = 1}) == "it has more than 1 triangles");
    CHECK(stlRefusal(file, {.points = 5}) == "it has more than 1 triangles");
  }
}

TEST_CASE("what stands behind an STL file's end is left out with a note", "[asset][stl]") {
  using NoteTexts = std::vector<std::string>;
  const TriangleMesh binary = meshIn(binaryStl() + "four", MeshFileKind::stl);
  CHECK(binary.triangles.size() == 2);
  CHECK(binary.notes == NoteTexts{"4 bytes after its last triangle are left out, at byte 184"});
  CHECK(meshIn(binaryStl(), MeshFileKind::stl).notes.empty());
  const TriangleMesh text = meshIn(kStlText + "\x1A", MeshFileKind::stl);
  CHECK(text.triangles.size() == 2);
  CHECK(text.notes == NoteTexts{"text after its last `endsolid` is left out, at line 17"});
  // A file with more trailing bytes than exporters append is refused.
  CHECK(stlRefusal(binaryStl() + std::string(5000, 'x')) ==
        "its header declares 2 triangles, which take 184 bytes, and the file has 5184 bytes, at byte 80");
}

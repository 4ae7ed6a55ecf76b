// Tests reading OBJ files as tools write them, and invalid ones.

#include "asset/read/obj_reader.h"

#include <clocale>

#include "catch.h"
#include "gltf_builder.h"
#include "mesh_bytes.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

TriangleMesh objOf(const std::string& file) { return meshIn(file, MeshFileKind::obj); }
std::string objRefusal(const std::string& file, const MeshLimits& limits = {}) {
  return refusalOf(file, MeshFileKind::obj, limits);
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("an OBJ file's faces become triangles, polygons as fans", "[asset][obj]") {
  CHECK(objOf(kSquare + "f 1 2 3\n").triangles == Triangles{{0, 1, 2}});
  CHECK(objOf(kSquare + "f 1 2 3 4").triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
  CHECK(objOf(kSquare + "f -4 -3 -2 -1\nv 5 5 5\nf -1 1 2\n").triangles == Triangles{{0, 1, 2}, {0, 2, 3}, {4, 0, 1}});
  // Faces may precede the points that they use.
  CHECK(objOf("f 1 2 3\n" + kSquare).triangles == Triangles{{0, 1, 2}});
  CHECK(objOf(kSquare + "f 1 2 3\n").points[2] == Point{1, 1, 0});
  CHECK(objOf("v +1.5e0 -2.E1 .25 1 # the weight\nv 0 0 0 0.1 0.2 0.3\nv 1e-999 0 0\nf 1 2 3\n").points ==
        std::vector<Point>{{1.5, -20, 0.25}, {0, 0, 0}, {0, 0, 0}});
}

TEST_CASE("an OBJ file's lines end, go on and are commented in every way", "[asset][obj]") {
  const Triangles two{{0, 1, 2}, {0, 2, 3}};
  std::string file = "\xEF\xBB\xBF# by hand \\\n\n" + kSquare +
                     "o house\ng a b \\\n c\ns off\nmtllib a.mtl\nl 1 2\nf 1 2 \\\n 3\\\n 4 # all\n";
  CHECK(objOf(file).triangles == two);
  for (const std::string end : {"\r\n", "\r"}) {
    std::string other;
    for (const char c : file) other += c == '\n' ? end : std::string(1, c);
    CHECK(objOf(other).triangles == two);
    CHECK(objRefusal(other + "f 1 2") == "a face has fewer than three corners, at line 16");
  }
}

TEST_CASE("an OBJ file's numbers are read in any locale", "[asset][obj]") {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // has no effect if this locale is not installed
  const TriangleMesh mesh = objOf("v 1.5 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  std::setlocale(LC_NUMERIC, before.c_str());
  CHECK(mesh.points[0].x == 1.5);
}

TEST_CASE("an OBJ file's materials are those of usemtl", "[asset][obj]") {
  const TriangleMesh mesh = objOf(kSquare +
                                  "f 1 2 3\nusemtl red brick \nf 1 2 3 4\nusemtl\nf 1 2 3\nusemtl w\x01\xFFood\n"
                                  "f 1 2 3\nusemtl red brick\nf 1 2 3\n");
  CHECK(mesh.material_names == std::vector<std::string>{"red brick", "w??ood"});
  CHECK(mesh.materials == std::vector<uint32_t>{kNoMaterial, 0, 0, kNoMaterial, 1, 0});
}

TEST_CASE("an OBJ file's normals and coordinates leave its points alone", "[asset][obj]") {
  const std::string values = kSquare + "vn 0 0 2\nvn 0 0 1\nvn 1 0 0\nvt 0 1\nvt 0.5\nvt 1 0 7\n";
  // All face corners at a point have equal normals and equal texture coordinates, so these are stored per point. A
  // point without a face gets zeros.
  TriangleMesh mesh = objOf(values + "f 1/1/1 2/2/2 3/3/1\nf 1/1/2 3/3/2 2/2/1\n");
  CHECK(mesh.points.size() == 4);
  CHECK(mesh.normals.corners.empty());
  CHECK(mesh.normals.values == std::vector<Normal>{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {}});
  CHECK(mesh.coordinates.corners.empty());
  CHECK(mesh.coordinates.values == std::vector<TextureCoordinates>{{0, 1}, {0.5f, 0}, {1, 0}, {}});
  // The corners at the first point have different normals, so normals are stored per corner.
  mesh = objOf(values + "f 1//1 2//2 3//1\nf 1//3 3//2 4//1\n");
  CHECK(mesh.points.size() == 4);
  CHECK(mesh.normals.corners == Triangles{{0, 1, 0}, {2, 1, 0}});
  CHECK(mesh.normalAt(1, 0) == Normal{1, 0, 0});
  CHECK(mesh.coordinates.empty());
  // Faces without texture coordinates get zeros, wherever they are in the file.
  mesh = objOf(values + "f 1 2 3\nf 1/-1 3/-2 4/-3\nf 2 3 4\n");
  CHECK(mesh.normals.empty());
  CHECK(mesh.coordinatesAt(0, 0) == TextureCoordinates{});
  CHECK(mesh.coordinatesAt(1, 0) == TextureCoordinates{1, 0});
  CHECK(mesh.coordinatesAt(2, 2) == TextureCoordinates{});
}

TEST_CASE("what is wrong with an OBJ file is said with its line", "[asset][obj]") {
  const std::pair<std::string, std::string> cases[] = {
      {"", "it is empty"},
      {kSquare, "it has no faces"},
      {"sgm 1;\nstart Ball;\n", "it is a grammar (.sgm), not a mesh file"},
      {"start 1;\nend Ball;\n", "it has no faces"},
      {std::string("\x7F"
                   "ELF\0\1\2",
                   7),
       "`?ELF???` is not a keyword of an OBJ file, at line 1"},
      {"v 0 0\n", "a `v` has fewer than 3 numbers, at line 1"},
      {"v 0 0 # 1\n", "a `v` has fewer than 3 numbers, at line 1"},
      {"\nvn 0 0\n", "a `vn` has fewer than 3 numbers, at line 2"},
      {"vt\n", "a `vt` has fewer than 1 numbers, at line 1"},
      {"v 0 0 1,5\n", "`1,5` is not a number, at line 1"},
      {"v 0 0 0x1p3\n", "`0x1p3` is not a number, at line 1"},
      {"v 0 0 +-1\n", "`+-1` is not a number, at line 1"},
      {"v 0 0 --1\n", "`--1` is not a number, at line 1"},
      {"v 0 nan 0\n", "a point that is not a number from -1000000 to 1000000, at line 1"},
      {"v 0 0 -inf\n", "a point that is not a number from -1000000 to 1000000, at line 1"},
      {"v 0 0 1e999\n", "a point that is not a number from -1000000 to 1000000, at line 1"},
      {"v 0 0 1000001\n", "a point that is not a number from -1000000 to 1000000, at line 1"},
      {"vn 0 0 nan\n", "a normal that is not finite, at line 1"},
      {"vt 1e39\n", "texture coordinates that are not finite, at line 1"},
      {kSquare + "f 1 2\n", "a face has fewer than three corners, at line 5"},
      {kSquare + "f 1 2 # 3\n", "a face has fewer than three corners, at line 5"},
      {kSquare + "f 1 2 0\n", "`0` is not a corner of a face, at line 5"},
      {kSquare + "f 1 2 -5\n", "`-5` is not a corner of a face, at line 5"},
      {kSquare + "f 1 2 3.5\n", "`3.5` is not a corner of a face, at line 5"},
      {kSquare + "f 1 2 3/\n", ""},
      {kSquare + "f 1 2 3//\n", ""},
      {kSquare + "f 1 2 /3\n", "`/3` is not a corner of a face, at line 5"},
      {kSquare + "f 1 2 3/x\n", "`3/x` is not a corner of a face, at line 5"},
      {kSquare + "f 1 2 3/1/1/1\n", "`3/1/1/1` is not a corner of a face, at line 5"},
      {kSquare + "f 1 2 99999999999999999999\n", "`99999999999999999999` is not a corner of a face, at line 5"},
      {kSquare + "f 1 2 4294967295\n", "`4294967295` is not a corner of a face, at line 5"},
      {kSquare + "f 1 2 5\nf 1 2 3\n", "a face names point 5, and the file has 4, at line 5"},
  };
  for (const auto& [file, message] : cases) {
    INFO(file);
    CHECK(objRefusal(file) == message);
  }
  CHECK(objRefusal(kSquare + "f 1 2 3 4", {.points = 3}) == "it has more than 3 points");
  CHECK(objRefusal(kSquare + "f 1 2 3 4", {.triangles = 1}) == "it has more than 1 triangles");
  CHECK(readMesh(bytesOf(kSquare + "f 1 2 9"), MeshFileKind::obj).error().message ==
        "a face names point 9, and the file has 4, at line 5; save it again as Wavefront OBJ, with its faces as `f` "
        "lines");
}

TEST_CASE("an OBJ file's concave polygons are cut, and crossing ones noted", "[asset][obj][polygon]") {
  // A prism with an L-shaped base; the list of the base's corners starts at each of its six points in turn.
  const std::string ring[6] = {"2 0", "2 1", "1 1", "1 2", "0 2", "0 0"};
  for (size_t first = 0; first < 6; ++first) {
    std::string points, low, high, sides;
    for (size_t i = 0; i < 6; ++i) {
      points +=
          "v " + ring[(first + i) % 6] + " 0\nv " + ring[(first + i) % 6] + " 1\nvt " + ring[(first + i) % 6] + "\n";
      const size_t now = 2 * i + 1, next = 2 * ((i + 1) % 6) + 1;
      const auto corner = [&](size_t point, size_t place) {
        return " " + std::to_string(point) + "/" + std::to_string(place + 1);
      };
      low = corner(now, i) + low;
      high += corner(now + 1, i);
      sides += "f " + std::to_string(now) + " " + std::to_string(next) + " " + std::to_string(next + 1) + " " +
               std::to_string(now + 1) + "\n";
    }
    // Faces that come before their points in the file are triangulated, too.
    for (const std::string& file :
         {points + "f" + low + "\nf" + high + "\n" + sides, "f" + low + "\nf" + high + "\n" + sides + points}) {
      const TriangleMesh mesh = objOf(file);
      CHECK(mesh.notes.empty());
      CHECK(openEdgesOf(mesh) == 0);
      CHECK(volumeOf(mesh) == 3);
      double area = 0;
      for (const auto& [a, b, c] : mesh.triangles)
        area += length(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a])) / 2;
      CHECK(area == 14);
      // Corners keep their texture coordinates, which equal x and y here.
      for (size_t t = 0; t < 8; ++t)
        for (size_t k = 0; k < 3; ++k)
          CHECK(double{mesh.coordinatesAt(t, k)[0]} == mesh.points[mesh.triangles[t][k]].x);
    }
  }
  const TriangleMesh crossed = objOf(kSquare + "f 1 2 4 3\nf 1 2 3 4\nf 1 3 2 4\n");
  CHECK(crossed.notes ==
        std::vector<std::string>{
            "2 polygons cross themselves or have no area, the first at line 5: triangles may overlap there"});
  // A corner that is repeated in succession counts once.
  CHECK(objOf(kSquare + "f 1 1 2 3 3 4 1").triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
  CHECK(objOf(kSquare + "f 1 1 2 2").triangles.size() == 2);
}

TEST_CASE("an OBJ file's references to what is not there are read with a note", "[asset][obj]") {
  using NoteTexts = std::vector<std::string>;
  const TriangleMesh empty = objOf(kSquare + "f 1// 2// 3//\nf 1/ 3/ 4/\n");
  CHECK(empty.triangles.size() == 2);
  CHECK(empty.notes.empty());
  CHECK(empty.normals.empty());
  const TriangleMesh without = objOf(kSquare + "f 1/1 2/2 3/3\n");
  CHECK(without.coordinates.empty());
  CHECK(without.notes == NoteTexts{"3 corners of faces name texture coordinates that the file does not have, such as "
                                   "number 3 at line 5: read without them"});
  const TriangleMesh some = objOf(kSquare + "vt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/0\nf 1//-2 2//9 3//1\n");
  CHECK(some.coordinatesAt(0, 0) == TextureCoordinates{1, 1});
  CHECK(some.coordinatesAt(0, 1) == TextureCoordinates{});
  CHECK(some.normalAt(1, 2) == Normal{0, 0, 1});
  CHECK(some.normalAt(1, 1) == Normal{});
  CHECK(
      some.notes ==
      NoteTexts{
          "3 corners of faces name normals that the file does not have, such as number 9 at line 8: read without them",
          "1 corner of a face names texture coordinates that the file does not have, such as number 2 at line 7: read "
          "without them"});
  const TriangleMesh never = objOf(kSquare + "vn 0 0 1\nf 1//1 2//0 3//1\n");
  CHECK(
      never.notes ==
      NoteTexts{
          "1 corner of a face names normals that the file does not have, such as those at line 6: read without them"});
}

TEST_CASE("what an OBJ file has beside faces is left out with a note", "[asset][obj]") {
  const TriangleMesh mesh =
      objOf(kSquare + "vp 0.5\nl 1 2\np 3\ncurv2 1 2\nf 1 2 3\ncall other.obj\nfancy 1\nfo 1 3 4\n");
  CHECK(mesh.triangles.size() == 2);
  CHECK(mesh.notes == std::vector<std::string>{
                          "2 elements of lines or points are left out, the first at line 6",
                          "1 curve or surface is left out, at line 8: save it as polygons to have them",
                          "1 call of another file or a command is left out, at line 10",
                          "1 line begins with a word that OBJ does not have and is left out, at line 11, `fancy`"});
  CHECK(objOf("o a name with blanks\ng one two\nmtllib a b.mtl c.mtl\n" + kSquare + "s off\nf 1 2 3\n").notes.empty());
}

// Tests reading PLY files as tools write them, and invalid ones.

#include "asset/read/ply_reader.h"

#include <limits>

#include "catch.h"
#include "gltf_builder.h"
#include "mesh_bytes.h"

using namespace sgm;
using namespace sgm::asset;

namespace {

std::string plyRefusal(const std::string& file, const MeshLimits& limits = {}) {
  return refusalOf(file, MeshFileKind::ply, limits);
}

/// A square and a triangle, with elements and properties that the reader ignores.
const std::string kPlyHeader =
    "ply\nformat ascii 1.0\ncomment by hand\nobj_info none\nelement camera 2\nproperty list uchar short view\n"
    "property float far\nelement nothing 99999999999\nelement vertex 4\nproperty double x\nproperty double y\n"
    "property uchar red\nproperty float z\nproperty list uchar int links\nproperty float nx\nproperty float ny\n"
    "property float nz\nproperty float s\nproperty float t\nelement face 3\nproperty short flags\n"
    "property list uint8 uint vertex_indices\nproperty list uchar float texcoord\nelement end 1\nproperty int x\n"
    "end_header\n";
const std::string kPlyNumbers =
    "2 7 8 1.5\n0 2.5\n0 0 255 0 0 0 0 2 0 0\n1 0 255 0 1 9 0 0 0.5 1 0\n1 1 255 -0.5 0 1 0 0 1 1\n"
    "0 1 255 0 2 8 9 0 1 0 0 1\n-1 4 0 1 2 3 0\n-1 3 0 1 2 6 0 0 1 0 1 1\n0 2 0 1 0\n7\n";

/// The contents of kPlyNumbers as binary data. turned: in reversed byte order.
std::string plyBytes(bool turned) {
  std::string out;
  const auto put = [&](auto value) { putNumber(out, value, turned); };
  put(uint8_t{2}), put(int16_t{7}), put(int16_t{8}), put(1.5f);
  put(uint8_t{0}), put(2.5f);
  const auto vertex = [&](double x, double y, float z, std::initializer_list<int32_t> links,
                          std::initializer_list<float> rest) {
    put(x), put(y), put(uint8_t{255}), put(z), put(static_cast<uint8_t>(links.size()));
    for (const int32_t link : links) put(link);
    for (const float number : rest) put(number);
  };
  vertex(0, 0, 0, {}, {0, 0, 2, 0, 0});
  vertex(1, 0, 0, {9}, {0, 0, 0.5f, 1, 0});
  vertex(1, 1, -0.5f, {}, {1, 0, 0, 1, 1});
  vertex(0, 1, 0, {8, 9}, {0, 1, 0, 0, 1});
  const auto face = [&](int16_t flags, std::initializer_list<uint32_t> corners, std::initializer_list<float> rest) {
    put(flags), put(static_cast<uint8_t>(corners.size()));
    for (const uint32_t corner : corners) put(corner);
    put(static_cast<uint8_t>(rest.size()));
    for (const float number : rest) put(number);
  };
  face(-1, {0, 1, 2, 3}, {});
  face(-1, {0, 1, 2}, {0, 0, 1, 0, 1, 1});
  face(0, {0, 1}, {});
  put(int32_t{7});
  return out;
}

std::string binaryPly(bool turned) {
  return replacedIn(kPlyHeader, "ascii", turned ? "binary_big_endian" : "binary_little_endian") + plyBytes(turned);
}

}  // namespace

TEST_CASE("a PLY file's faces become triangles, as text and in bytes of either order", "[asset][ply]") {
  std::string windows;
  for (const char c : kPlyHeader + kPlyNumbers) windows += c == '\n' ? "\r\n" : std::string(1, c);
  std::string one_line = kPlyNumbers;
  for (char& c : one_line)
    if (c == '\n') c = ' ';
  for (const std::string& file :
       {kPlyHeader + kPlyNumbers, windows, kPlyHeader + one_line, binaryPly(false), binaryPly(true)}) {
    const TriangleMesh mesh = meshIn(file, MeshFileKind::ply);
    CHECK(mesh.triangles == std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}});
    CHECK(mesh.points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 1, -0.5}, {0, 1, 0}});
    CHECK(mesh.normals.values == std::vector<Normal>{{0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}});
    CHECK(mesh.coordinates.values == std::vector<TextureCoordinates>{{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    CHECK(mesh.materials.size() == 3);
  }
}

TEST_CASE("a PLY file's elements may come in any order, and its header end as lines do", "[asset][ply]") {
  const std::string faces_first =
      "ply\nformat ascii 1.0\nelement face 1\nproperty list char int vertex_index\nelement vertex 3\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n3 2 1 0\n0 0 0 1 0 0 0 1 0";
  const TriangleMesh mesh = meshIn(faces_first, MeshFileKind::ply);
  CHECK(mesh.triangles == std::vector<std::array<uint32_t, 3>>{{2, 1, 0}});
  CHECK(mesh.normals.empty());
  CHECK(plyRefusal(replacedIn(faces_first, "3 2 1 0", "3 2 1 3")) ==
        "face 0 has a corner that is not one of the file's 3 vertices, at line 10");
  // If the file has one vertex more than its header declares, the line of the last vertex is read as a face.
  const std::string five =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  CHECK(plyRefusal(five + "1 7 1\n3 0 1 2\n") ==
        "face 0 has a corner that is not one of the file's 4 vertices: the file has more lines than the header "
        "declares, perhaps more vertices, at line 14");
  CHECK(plyRefusal(five + "0.5 1 1\n3 0 1 2\n") ==
        "it has a list without a length within 0 of 1 of the element `face`, counted from 0: the file has more lines "
        "than the header declares, perhaps more vertices, at line 14");
  // The first byte of the binary data is that of a newline. It must not be taken for a part of the line end that ends
  // the header.
  std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\n"
      "property uchar z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
  const std::string numbers("\n\0\0\1\0\0\0\1\0\3\0\1\2", 13);
  std::string windows, old;
  for (const char c : binary) windows += c == '\n' ? "\r\n" : std::string(1, c);
  for (const char c : binary) old += c == '\n' ? '\r' : c;
  for (const std::string& header : {binary, windows, old})
    CHECK(meshIn(header + numbers, MeshFileKind::ply).points[0] == Point{10, 0, 0});
}

TEST_CASE("what is wrong with a PLY file is said with its line or its byte", "[asset][ply]") {
  const std::string text = kPlyHeader + kPlyNumbers, bytes = binaryPly(false);
  const auto with = [&](const std::string& from, const std::string& to) { return replacedIn(text, from, to); };
  const size_t body = bytes.size() - plyBytes(false).size();
  const auto at = [&](size_t byte) { return ", at byte " + std::to_string(body + byte); };
  const std::pair<std::string, std::string> cases[] = {
      {"", "it is empty"},
      {"hello\n", "it is not a PLY file: it does not begin with `ply`, at line 1"},
      {"ply\nformat ascii 1.0\n", "it ends within its header, at line 3"},
      {"ply\nend_header\n", "its header has no `format`, at line 2"},
      {with("ascii", "binary"),
       "it has the format `binary` of version `1.0`; the formats of version 1.0 are `ascii`, `binary_little_endian` "
       "and `binary_big_endian`, at line 2"},
      {with("comment", "remark"), "`remark` is not a keyword of a PLY header, at line 3"},
      {with("camera 2", "camera -2"), "`-2` is not a number of elements, at line 5"},
      {with("camera 2", "camera"), "`` is not a number of elements, at line 5"},
      {with("camera 2", "camera 99999999999999999999"),
       "`99999999999999999999` is not a number of elements, at line 5"},
      {with("element camera 2", "property int x"), "a property stands before the first element, at line 5"},
      {with("element camera", "element face"), "it has two elements `face`, at line 20"},
      {with("list uchar short", "list float short"), "`float` is not a type of a list's length, at line 6"},
      {with("list uchar short", "list uchar long"), "`long` is not a type of a property, at line 6"},
      {with("float far", "float"), "a property has no name, at line 7"},
      {with("element vertex", "element point"), "it has no element `vertex`"},
      {with("element face", "element polygon"), "it has no element `face`"},
      {with("double y", "double why"), "its element `vertex` has not all of x, y and z"},
      {with("uint vertex_indices", "float vertex_indices"),
       "its element `face` has no list `vertex_indices` of whole numbers"},
      {with("property list uint8 uint vertex_indices", "property uint vertex_indices"),
       "its element `face` has no list `vertex_indices` of whole numbers"},
      {with("vertex 4", "vertex 4000000"),
       "its header declares 4000000 of the element `vertex`, and it has bytes for 7 at most, at line 28"},
      {with("255 -0.5", "255 x"),
       "it has `x`, which is not a number, within 2 of 4 of the element `vertex`, counted from "
       "0, at line 31"},
      {with("255 -0.5", "255 nan"),
       "vertex 2 has a position that is not a number from -1000000 to 1000000, at line 31"},
      {with("0 2 0 0\n", "0 inf 0 0\n"), "vertex 0 has a normal that is not finite, at line 29"},
      {with("0 2 0 0\n", "0 2 0 nan\n"), "vertex 0 has texture coordinates that are not finite, at line 29"},
      {with("-1 4 0 1 2 3", "-1 4 0 1 2 4"),
       "face 0 has a corner that is not one of the file's 4 vertices, at line 33"},
      {with("-1 4 0 1 2 3", "-1 4 0 1 2 -1"),
       "face 0 has a corner that is not one of the file's 4 vertices, at line 33"},
      {with("-1 4 0 1 2 3", "-1 4 0 1 2 0.5"),
       "face 0 has a corner that is not one of the file's 4 vertices, at line 33"},
      {with("-1 4 0 1 2 3", "-1 4 0 1 2 nan"),
       "face 0 has a corner that is not one of the file's 4 vertices, at line 33"},
      {with("-1 4 0", "-1 -4 0"),
       "it has a list without a length within 0 of 3 of the element `face`, counted from 0, at line 33"},
      {with("-1 4 0", "-1 1e300 0"),
       "a line has fewer values than the header declares within 0 of 3 of the element `face`, counted from 0, at line "
       "33"},
      {with("element face 3", "element face 0"), "it has no triangles"},
      {text.substr(0, text.find("\n0 2 0 1 0")),
       "it ends within 2 of 3 of the element `face`, counted from 0, at line 34"},
      {replacedIn(bytes, "vertex 4", "vertex 400000"),
       "its header declares 400000 of the element `vertex`, and it has bytes for 6 at most" +
           std::string(", at byte ") + std::to_string(body + 5 + 14)},
      {bytes.substr(0, bytes.size() - 9),
       "it ends within 2 of 3 of the element `face`, counted from 0" + at(plyBytes(false).size() - 16)},
      {bytes.substr(0, body + 3),
       "its header declares 2 of the element `camera`, and it has bytes for 0 at most" + at(0)},
  };
  for (const auto& [file, message] : cases) {
    INFO(file);
    CHECK(plyRefusal(file) == message);
  }
  CHECK(plyRefusal(text, {.points = 3}) == "it has more than 3 points");
  CHECK(plyRefusal(text, {.triangles = 2}) == "it has more than 2 triangles");
  // The header declares 32-bit lengths of lists, but the data have 8-bit ones: the first length read is huge.
  std::string turned = binaryPly(true);
  const std::string list = "list uint8 uint vertex_indices";
  turned = replacedIn(turned, list, "list uint32 uint vertex_indices");
  CHECK(plyRefusal(turned).starts_with("face 0 has a corner that is not one of the file's 4 vertices, at byte "));
}

TEST_CASE("a PLY text's line is a record: what it holds beyond is never taken for something else", "[asset][ply]") {
  using NoteTexts = std::vector<std::string>;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nproperty uchar red\nend_header\n";
  const std::string points = "0 0 0\n3 0 0\n0 3 0\n0 0 3\n", faces = "3 0 2 1 7\n3 0 1 3 7\n3 1 2 3 7\n3 2 0 3 7\n";
  const auto read = [&](const std::string& body) { return meshIn(header + body, MeshFileKind::ply); };
  const TriangleMesh plain = read(points + faces);
  CHECK(volumeOf(plain) == 4.5);
  CHECK(plain.notes.empty());
  // Some exporters write values of a property that the header does not declare, for faces or vertices. These values are
  // left out, with a note.
  const TriangleMesh more = read(points + "3 0 2 1 7 9 9\n3 0 1 3 7 9 9\n3 1 2 3 7 9 9\n3 2 0 3 7 9 9\n");
  CHECK(more.triangles == plain.triangles);
  CHECK(more.notes == NoteTexts{"4 lines have more values than the header declares, the first at line 15: left out"});
  const TriangleMesh coloured = read("0 0 0 255\n3 0 0 255\n0 3 0 255\n0 0 3 255\n" + faces);
  CHECK(volumeOf(coloured) == 4.5);
  CHECK(coloured.notes.size() == 1);
  // Records may span several lines, and a line may hold several.
  CHECK(volumeOf(read("0\n0 0\n3 0\n0\n0 3 0\n0 0 3\n3\n0 2 1 7\n3 0 1 3\n7\n3 1 2 3 7\n3 2 0 3 7")) == 4.5);
  CHECK(volumeOf(read("0 0 0 3 0 0 0 3 0 0 0 3 3 0 2 1 7 3 0 1 3 7 3 1 2 3 7 3 2 0 3 7")) == 4.5);
  CHECK(read(points + faces + "# the end\n").notes == NoteTexts{"text after its last element is left out, at line 19"});
  // If it is not clear to which element a value belongs, an error is reported.
  CHECK(
      plyRefusal(header + "0 0\n3 0 0\n0 3 0\n0 0 3\n" + faces) ==
      "a line has fewer values than the header declares within 0 of 4 of the element `vertex`, counted from 0, at line "
      "11");
  CHECK(plyRefusal(header + "0 0\n0 3 0 0\n0 3 0\n0 0 3\n" + faces + "1\n1\n") ==
        "a line has more values than the header declares, after one with fewer within 0 of 4 of the element `vertex`, "
        "counted from 0, at line 12");
  CHECK(plyRefusal(header + "0 0 0 3 0 0 0 3 0 0 0 3 3 0 2 1 7 3 0 1 3 7 3 1 2 3 7 3 2 0 3 7 8") ==
        "it has more values than the header declares, at line 11");
}

TEST_CASE("a PLY file's polygons are cut, and its strips are triangles", "[asset][ply][polygon]") {
  const auto head = [](const std::string& format, size_t vertices) {
    return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\n";
  };
  const std::string c = "0 0 0\n3 0 0\n3 1 0\n1 1 0\n1 2 0\n3 2 0\n3 3 0\n0 3 0\n";
  const std::string list = "element face 1\nproperty list uchar int vertex_index\nend_header\n";
  for (const std::string& file :
       {head("ascii", 8) + list + c + "8 3 4 5 6 7 0 1 2\n", head("ascii", 8) + list + c + "9 3 4 5 6 7 0 1 2 2\n"}) {
    const TriangleMesh mesh = meshIn(file, MeshFileKind::ply);
    double area = 0;
    for (const auto& [p, q, r] : mesh.triangles)
      area += cross(mesh.points[q] - mesh.points[p], mesh.points[r] - mesh.points[p]).z / 2;
    CHECK(mesh.triangles.size() == 6);
    CHECK(area == 7);
  }
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  const std::string tetrahedron = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const TriangleMesh strip =
      meshIn(head("ascii", 4) + strips + tetrahedron + "12 1 0 2 3 -1 2 3 1 -1 3 0 1\n", MeshFileKind::ply);
  CHECK(strip.triangles == std::vector<std::array<uint32_t, 3>>{{1, 0, 2}, {2, 0, 3}, {2, 3, 1}, {3, 0, 1}});
  CHECK(meshIn(head("ascii", 4) + "element face 2\nproperty list uchar int vertex_index\nend_header\n" + tetrahedron +
                   "2 0 1\n3 0 1 2\n",
               MeshFileKind::ply)
            .notes == std::vector<std::string>{"1 face has fewer than three corners and is left out, at line 14"});
  std::string binary = replacedIn(head("ascii", 3), "ascii", "binary_little_endian") + list;
  for (const float v : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) putNumber(binary, v);
  binary += '\3';
  for (const int32_t corner : {0, 1, 2}) putNumber(binary, corner);
  CHECK(meshIn(binary, MeshFileKind::ply).notes.empty());
  CHECK(meshIn(binary + "xy", MeshFileKind::ply).notes ==
        std::vector<std::string>{"2 bytes after its last element are left out, at byte " +
                                 std::to_string(binary.size())});
}

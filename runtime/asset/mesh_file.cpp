#include "asset/mesh_file.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "asset/glb_reader.h"
#include "asset/mesh_origin.h"
#include "asset/obj_reader.h"
#include "asset/ply_reader.h"
#include "asset/stl_reader.h"
#include "asset/text_reader.h"

namespace sgm::asset {

namespace {

constexpr std::string_view kKindNames[] = {"glb", "obj", "ply", "stl"};

Result<TriangleMesh> readKind(std::span<const std::byte> bytes, MeshFileKind kind, const MeshLimits& limits) {
  switch (kind) {
    case MeshFileKind::glb:
      return readGlb(bytes, limits);
    case MeshFileKind::obj:
      return readObj(bytes, limits);
    case MeshFileKind::ply:
      return readPly(bytes, limits);
    case MeshFileKind::stl:
      return readStl(bytes, limits);
  }
  return Error{Code::invalid_argument, "no such kind of mesh file", 0, 0};
}

/// Whether the first line that is no comment is one of an OBJ file.
bool beginsAsObj(std::string_view text) {
  constexpr std::string_view kFirst[] = {"v", "vt", "vn", "mtllib", "usemtl", "o", "g", "s"};
  TextReader reader(text);
  std::string_view word = reader.word();
  while ((word.empty() || word[0] == '#') && reader.nextLine()) word = reader.word();
  return std::find(std::begin(kFirst), std::end(kFirst), word) != std::end(kFirst);
}

}  // namespace

Result<MeshFileKind> meshFileKind(std::string_view path) {
  std::string end(path.substr(std::min(path.size(), path.find_last_of("./\\"))));
  for (char& c : end)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  for (size_t i = 0; i < std::size(kKindNames); ++i)
    if (end == "." + std::string(kKindNames[i])) return static_cast<MeshFileKind>(i);
  return Error{Code::invalid_argument,
               std::string(path) + ": no mesh format that we can read; .glb, .obj, .ply and .stl are", 0, 0};
}

std::optional<MeshFileKind> meshFileKind(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("glTF")) return MeshFileKind::glb;
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return MeshFileKind::ply;
  if (isBinaryStl(bytes) || text.starts_with("solid")) return MeshFileKind::stl;
  if (beginsAsObj(text)) return MeshFileKind::obj;
  return std::nullopt;
}

std::string_view meshFileAdvice(MeshFileKind kind) {
  switch (kind) {
    case MeshFileKind::glb:
      return kGlbAdvice;
    case MeshFileKind::obj:
      return "save it again as Wavefront OBJ, with its faces as `f` lines";
    case MeshFileKind::ply:
      return "save it again as PLY 1.0, with the elements `vertex` and `face`";
    case MeshFileKind::stl:
      return "save it again as binary STL";
  }
  return {};
}

Result<TriangleMesh> readMesh(std::span<const std::byte> bytes, MeshFileKind kind, const MeshLimits& limits) {
  Result<TriangleMesh> mesh = readKind(bytes, kind, limits);
  if (mesh) mesh->origin = originOf(bytes);
  if (mesh || mesh.error().code == Code::invalid_argument) return mesh;
  Error error = mesh.error();
  error.message.append("; ").append(error.code == Code::limit ? "simplify it, or split it into several files"
                                                              : meshFileAdvice(kind));
  return error;
}

}  // namespace sgm::asset

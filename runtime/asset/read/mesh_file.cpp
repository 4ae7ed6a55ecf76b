#include "asset/read/mesh_file.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "asset/read/foreign_file.h"
#include "asset/read/glb_container.h"
#include "asset/read/glb_reader.h"
#include "asset/read/mesh_origin.h"
#include "asset/read/obj_reader.h"
#include "asset/read/ply_reader.h"
#include "asset/read/stl_reader.h"
#include "asset/read/text_encoding.h"
#include "asset/read/text_reader.h"

namespace sgm::asset {

namespace {

constexpr std::string_view kKindNames[] = {"glb", "obj", "ply", "stl"};
constexpr std::string_view kKindTitles[] = {"glTF", "OBJ", "PLY", "STL"};
constexpr std::string_view kNoFormat = "the mesh format is unsupported; use .glb, .gltf, .obj, .ply or .stl";

std::string titleOf(MeshFileKind kind) { return std::string(kKindTitles[static_cast<size_t>(kind)]); }

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
  return Error{Code::invalid_argument, "there is no such kind of mesh file", 0, 0};
}

/// True if the first line that is neither empty nor a comment is valid in an OBJ file.
bool beginsAsObj(std::string_view text) {
  constexpr std::string_view kFirst[] = {"v", "vt", "vn", "mtllib", "usemtl", "o", "g", "s", "f", "l", "p"};
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
  if (end == ".gltf") return MeshFileKind::glb;
  for (size_t i = 0; i < std::size(kKindNames); ++i)
    if (end == "." + std::string(kKindNames[i])) return static_cast<MeshFileKind>(i);
  return Error{Code::invalid_argument, std::string(path) + ": " + std::string(kNoFormat), 0, 0};
}

std::optional<MeshFileKind> meshFileKind(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("glTF")) return MeshFileKind::glb;
  if (text.starts_with("ply") && TextReader(text).rest() == "ply") return MeshFileKind::ply;
  if (isBinaryStl(bytes) || isTextStl(bytes)) return MeshFileKind::stl;
  if (beginsAsGltf(text)) return MeshFileKind::glb;
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

Result<TriangleMesh> readMeshOf(std::span<const std::byte> bytes, std::optional<MeshFileKind>& kind,
                                const MeshLimits& limits) {
  if (bytes.empty()) return Error{Code::bad_input, "it is empty", 0, 0};
  // Test for binary formats first (by first bytes or size): a binary file may also begin as a text format does.
  std::optional<MeshFileKind> found = isBinaryStl(bytes) ? std::optional(MeshFileKind::stl) : std::nullopt;
  const DecodedText decoded(found ? std::span<const std::byte>() : bytes);
  const std::span<const std::byte> content = found ? bytes : decoded.bytes();
  if (!found) found = meshFileKind(content);
  if (!found)
    if (const std::string_view foreign = foreignFile(content); !foreign.empty())
      return Error{Code::bad_input, "it is " + std::string(foreign), 0, 0};
  const std::optional<MeshFileKind> named = std::exchange(kind, found ? found : kind);
  if (!kind) return Error{Code::bad_input, std::string(kNoFormat), 0, 0};
  Result<TriangleMesh> mesh = readKind(content, *kind, limits);
  if (!mesh) return mesh;
  mesh->origin = originOf(content);
  mesh->in_metres = kind == MeshFileKind::glb;
  if (kind != named) {
    std::string note = "by its bytes it is " + titleOf(*kind);
    if (named) note += ", not " + titleOf(*named) + " as its name or type says";
    mesh->notes.insert(mesh->notes.begin(), note + ", and is read as such");
  }
  return mesh;
}

Result<TriangleMesh> readMesh(std::span<const std::byte> bytes, std::optional<MeshFileKind> named,
                              const MeshLimits& limits) {
  Result<TriangleMesh> mesh = readMeshOf(bytes, named, limits);
  if (mesh || mesh.error().code == Code::invalid_argument || !named) return mesh;
  Error error = mesh.error();
  error.message.append("; ").append(error.code == Code::limit ? "simplify it, or split it into several files"
                                                              : meshFileAdvice(*named));
  return error;
}

}  // namespace sgm::asset

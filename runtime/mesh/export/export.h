#pragma once
// A welded mesh as a file that other programs read.

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/file_writer.h"
#include "base/result.h"
#include "mesh/weld.h"

namespace sgm {

struct ExportMaterial {
  std::string name;
  std::array<float, 3> colour{0.8f, 0.8f, 0.8f};  ///< linear, 0..1
  float roughness = 0.9f;                         ///< 0..1
};

/// Two materials and how they share a place; all triangles at a place have the same two. Shares in 255ths.
struct ExportBlend {
  std::array<uint16_t, 2> materials{};  ///< both the same: one alone
  uint8_t share = 0;                    ///< of the second
  std::array<uint8_t, 3> planes{};      ///< of textures laid along x, y and z; all 0: by coordinates
};

/// Where charts or pairs of materials meet a vertex has several places on the texture.
struct ExportTexture {
  std::span<const uint32_t> vertices;  ///< of the mesh, one a place
  std::span<const std::array<float, 2>> coordinates;
  std::span<const ExportBlend> blends;  ///< one a place
  std::span<const uint32_t> corners;    ///< into these, in the place of the mesh's indices
  std::span<const std::byte> png;       ///< a file that repeats over all of it; empty: none
};

/// What a file says beside the mesh. Indices beyond the tables are written as a grey material "material N".
struct ExportInfo {
  std::string name = "mesh";      ///< of the object
  std::string generator = "sgm";  ///< program and version
  std::vector<ExportMaterial> materials;
  std::vector<std::string> tags;
  const ExportTexture* texture = nullptr;  ///< borrowed; null: none. Not for .ply and .stl, which hold none
};

enum class MeshFormat { glb, obj, ply, stl };

/// By extension, of any case. Error: Code::invalid_argument, naming the four.
Result<MeshFormat> meshFormatOf(const std::filesystem::path& path);

/// A file for a mesh, opened before there is one, so that what cannot be written shows before the work.
///
/// Positions are in metres from mesh.origin, rounded to float32.
///  .glb  binary glTF 2.0: one primitive a material with vertices of its own, POSITION, NORMAL, _TAG; the scene's
///        extras hold the origin in units and metres and the tag names. With a texture TEXCOORD_0 and _BLEND, the
///        shares of planes (xyz) and of the second material (w); pairs of materials have primitives of their own,
///        whose colours COLOR_0 blends and whose material's extras name the two
///  .obj  text, with normals and usemtl, with a texture's coordinates; the materials in a .mtl file beside it,
///        of the same name if that has plain letters, digits, `.`, `-` and `_` alone
///  .ply  binary little-endian: x y z nx ny nz red green blue material tag; origin, materials and tags as comments
///  .stl  binary, with facet normals: positions alone, so that a reader welds by position
/// A triangle takes the material that two of its vertices share, else that of its first. An empty mesh makes a valid
/// file. Files appear whole or not at all (FileWriter), both or neither of .obj and .mtl.
class MeshFile {
 public:
  /// In the format of the path's extension. unfinished: see FileWriter. Errors: Code::io, also where the .mtl of an
  /// .obj was written by others; Code::invalid_argument for the extension.
  static Result<MeshFile> create(const std::filesystem::path& path, UnfinishedFiles* unfinished = nullptr);
  /// Whether files of the path's format have texture coordinates.
  static bool holdsTexture(const std::filesystem::path& path);
  /// Once. Errors: Code::io; Code::limit where the format cannot hold the mesh.
  Result<void> write(const WorldMesh& mesh, const ExportInfo& info);

  /// What write leaves: the path, and the .mtl of an .obj.
  const std::vector<std::filesystem::path>& paths() const { return paths_; }
  /// Of all of them, once written.
  uint64_t bytes() const;

 private:
  explicit MeshFile(MeshFormat format) : format_(format) {}

  MeshFormat format_;
  std::vector<std::filesystem::path> paths_;
  std::vector<FileWriter> files_;  // one a path
};

/// MeshFile in one go.
Result<void> exportMesh(const WorldMesh& mesh, const ExportInfo& info, const std::filesystem::path& path);

}  // namespace sgm

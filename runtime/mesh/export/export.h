#pragma once
// Writes a welded mesh to a file for other programs.

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

/// Two materials and their shares at a vertex; all triangles there have the same two. Shares in 255ths.
struct ExportBlend {
  std::array<uint16_t, 2> materials{};  ///< both the same: one material
  uint8_t share = 0;                    ///< of the second
  std::array<uint8_t, 3> planes{};      ///< shares of textures projected along x, y and z; all 0: by coordinates
};

/// Texture vertices. At the border of charts or pairs of materials, a mesh vertex has several.
struct ExportTexture {
  std::span<const uint32_t> vertices;  ///< of the mesh, one per texture vertex
  std::span<const std::array<float, 2>> coordinates;
  std::span<const ExportBlend> blends;  ///< one per texture vertex
  std::span<const uint32_t> corners;    ///< into these, parallel to the mesh's indices
  std::span<const std::byte> png;       ///< an image file that repeats over the whole mesh; empty: none
};

/// Additional content of the file. Materials with indices beyond the table are written as grey, named "material N".
struct ExportInfo {
  std::string name = "mesh";      ///< of the object
  std::string generator = "sgm";  ///< program and version
  std::vector<ExportMaterial> materials;
  std::vector<std::string> tags;
  const ExportTexture* texture = nullptr;  ///< borrowed; null: none. Not for .ply and .stl, which store none
};

enum class MeshFormat { glb, obj, ply, stl };

/// The format by the file extension, in any case. Error: Code::invalid_argument, with the four extensions.
Result<MeshFormat> meshFormatOf(const std::filesystem::path& path);

/// A file for a mesh, opened before the mesh exists, so that an unwritable path is reported before the work.
///
/// Positions are in metres from mesh.origin, rounded to float32.
///  .glb  binary glTF 2.0: one primitive per material with vertices of its own, POSITION, NORMAL, _TAG; the scene's
///        extras hold the origin in units and metres and the tag names. With a texture TEXCOORD_0 and _BLEND, the
///        shares of planes (xyz) and of the second material (w); pairs of materials have primitives of their own,
///        whose colours COLOR_0 blends and whose material's extras name the two
///  .obj  text, with normals and usemtl, with a texture's coordinates; the materials are in a .mtl file beside it,
///        of the same name if that consists of ASCII letters, digits, `.`, `-` and `_`
///  .ply  binary little-endian: x y z nx ny nz red green blue material tag; origin, materials and tags as comments
///  .stl  binary, with facet normals and positions only, so that a reader must weld by position
/// A triangle has the material that two of its vertices share, or else that of its first vertex. An empty mesh makes a
/// valid file. Files appear complete or not at all (FileWriter); .obj and .mtl appear together or not at all.
class MeshFile {
 public:
  /// Uses the format of the path's extension. unfinished: see FileWriter. Errors: Code::io, also if another program
  /// wrote the .mtl of an .obj; Code::invalid_argument for the extension.
  static Result<MeshFile> create(const std::filesystem::path& path, UnfinishedFiles* unfinished = nullptr);
  /// True if files of the path's format can hold texture coordinates.
  static bool holdsTexture(const std::filesystem::path& path);
  /// Call once. Errors: Code::io; Code::limit if the format cannot hold the mesh.
  Result<void> write(const WorldMesh& mesh, const ExportInfo& info);

  /// The files that write creates: the path, and the .mtl of an .obj.
  const std::vector<std::filesystem::path>& paths() const { return paths_; }
  /// The size of all of them, after write.
  uint64_t bytes() const;

 private:
  explicit MeshFile(MeshFormat format) : format_(format) {}

  MeshFormat format_;
  std::vector<std::filesystem::path> paths_;
  std::vector<FileWriter> files_;  // one per path
};

/// Creates and writes a MeshFile in one call.
Result<void> exportMesh(const WorldMesh& mesh, const ExportInfo& info, const std::filesystem::path& path);

}  // namespace sgm

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

/// Two materials and their shares at a vertex, in 255ths. All corners of a triangle have the same two materials.
struct ExportBlend {
  std::array<uint16_t, 2> materials{};  ///< equal if the vertex has only one material
  uint8_t share = 0;                    ///< share of the second material, in 255ths
  /// shares of the texture's projections along x, y and z, in 255ths; all 0: the texture is mapped by coordinates
  std::array<uint8_t, 3> planes{};
};

/// Vertices with texture coordinates. A mesh vertex at the border of two texture charts, or of two pairs of materials,
/// has several texture vertices.
struct ExportTexture {
  std::span<const uint32_t> vertices;                 ///< index of the mesh vertex of each texture vertex
  std::span<const std::array<float, 2>> coordinates;  ///< texture coordinates, one pair per texture vertex
  std::span<const ExportBlend> blends;                ///< materials and projections at each texture vertex
  std::span<const uint32_t> corners;                  ///< index of the texture vertex at each triangle corner
  std::span<const std::byte> png;                     ///< content of a PNG file, repeated over the mesh; may be empty
};

/// Additional content of an exported file. Triangles with a material index beyond `materials` are written in grey, as
/// "material N".
struct ExportInfo {
  std::string name = "mesh";      ///< name of the object
  std::string generator = "sgm";  ///< name and version of the program that writes the file
  std::vector<ExportMaterial> materials;
  std::vector<std::string> tags;
  /// borrowed; null: no texture. Ignored by .ply and .stl, which cannot store it
  const ExportTexture* texture = nullptr;
};

enum class MeshFormat { glb, obj, ply, stl };

/// Returns the format for a file extension, in upper or lower case. Error: Code::invalid_argument; its message lists
/// the four extensions.
Result<MeshFormat> meshFormatOf(const std::filesystem::path& path);

/// An output file that is opened before the mesh is computed, so that an unwritable path is reported early.
///
/// Positions are in metres from mesh.origin, rounded to float32.
///  .glb  binary glTF 2.0: one primitive per material, with vertices of its own (POSITION, NORMAL, _TAG). The scene's
///        extras hold the tag names, and the origin in units and metres. With a texture, vertices also have TEXCOORD_0
///        and _BLEND: the shares of the projections (xyz) and of the second material (w). Each pair of materials then
///        has a primitive of its own, with blended colours (COLOR_0) and with both names in its material's extras.
///  .obj  text, with normals and usemtl, and with texture coordinates if there are any; the materials are in a .mtl
///        file beside it, of the same name if that consists of ASCII letters, digits, `.`, `-` and `_`
///  .ply  binary little-endian: x y z nx ny nz red green blue material tag; origin, materials and tags as comments
///  .stl  binary, with facet normals and positions only, so that a reader must weld by position
/// A triangle has the material that two of its vertices share, or else that of its first vertex. An empty mesh makes a
/// valid file. Files appear complete or not at all (FileWriter); .obj and .mtl appear together or not at all.
class MeshFile {
 public:
  /// Uses the format of the path's extension. unfinished: see FileWriter. Errors: Code::io, also if the .mtl beside an
  /// .obj exists and was written by another program; Code::invalid_argument if the extension is unknown.
  static Result<MeshFile> create(const std::filesystem::path& path, UnfinishedFiles* unfinished = nullptr);
  /// True if files of the path's format can hold texture coordinates.
  static bool holdsTexture(const std::filesystem::path& path);
  /// Call once. Errors: Code::io; Code::limit if the format cannot hold the mesh.
  Result<void> write(const WorldMesh& mesh, const ExportInfo& info);

  /// Returns the paths of the files that write() creates: the given path, and for an .obj that of its .mtl.
  const std::vector<std::filesystem::path>& paths() const { return paths_; }
  /// Returns the total size of the files, once write() has succeeded.
  uint64_t bytes() const;

 private:
  explicit MeshFile(MeshFormat format) : format_(format) {}

  MeshFormat format_;
  std::vector<std::filesystem::path> paths_;
  std::vector<FileWriter> files_;  // one writer per path
};

/// Creates and writes a MeshFile in one call.
Result<void> exportMesh(const WorldMesh& mesh, const ExportInfo& info, const std::filesystem::path& path);

}  // namespace sgm

#pragma once
// The writers behind exportMesh, one per format, and their common functions.

#include <array>
#include <string>

#include "base/file_writer.h"
#include "mesh/export/export.h"

namespace sgm {

Result<void> writeGlb(const WorldMesh& mesh, const ExportInfo& info, FileWriter& file);
Result<void> writePly(const WorldMesh& mesh, const ExportInfo& info, FileWriter& file);
Result<void> writeStl(const WorldMesh& mesh, const ExportInfo& info, FileWriter& file);
/// Writes an .obj to `file` and its materials to `library`. library_name: the .mtl name that the .obj refers to.
Result<void> writeObj(const WorldMesh& mesh, const ExportInfo& info, const std::string& library_name,
                      FileWriter& library, FileWriter& file);
/// Returns the name of the .mtl file for an .obj. Many readers end a name at a space and accept only ASCII letters, so
/// a name with other characters is replaced by a unique name without them.
std::string materialLibraryName(const std::filesystem::path& obj);
/// Checks whether a .mtl file may be replaced. Error: Code::io if the file exists and was not written by writeObj().
Result<void> mayReplaceLibrary(const std::filesystem::path& library);

using Float3 = std::array<float, 3>;

Float3 exportedPosition(const WorldMesh& mesh, uint32_t vertex);
Float3 exportedNormal(const WorldMesh& mesh, uint32_t vertex);
uint16_t triangleMaterial(const WorldMesh& mesh, size_t first_index);
ExportMaterial materialAt(const ExportInfo& info, uint16_t index);
/// Returns the shortest text that reads back as the same number, in any locale.
std::string decimalText(float value);
std::string decimalText(double value);
/// Replaces line breaks and other control characters by spaces, so that a name stays within its line of the file.
std::string oneLine(std::string text);

}  // namespace sgm

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
/// library_name: the name of the library in the file.
Result<void> writeObj(const WorldMesh& mesh, const ExportInfo& info, const std::string& library_name,
                      FileWriter& library, FileWriter& file);
/// The file name of the materials of an .obj. Many readers end a name at a space and accept only ASCII letters: a name
/// with other characters is replaced by a unique one.
std::string materialLibraryName(const std::filesystem::path& obj);
/// Error: Code::io if a file exists there that writeObj has not written.
Result<void> mayReplaceLibrary(const std::filesystem::path& library);

using Float3 = std::array<float, 3>;

Float3 exportedPosition(const WorldMesh& mesh, uint32_t vertex);
Float3 exportedNormal(const WorldMesh& mesh, uint32_t vertex);
uint16_t triangleMaterial(const WorldMesh& mesh, size_t first_index);
ExportMaterial materialAt(const ExportInfo& info, uint16_t index);
/// The shortest text that reads back as the same number, in any locale.
std::string decimalText(float value);
std::string decimalText(double value);
/// Line breaks and other control characters become spaces, so that a name stays within its line.
std::string oneLine(std::string text);

}  // namespace sgm

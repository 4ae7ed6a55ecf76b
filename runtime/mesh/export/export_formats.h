#pragma once
// The writers behind exportMesh, one a format, and what they share.

#include <array>
#include <string>

#include "base/file_writer.h"
#include "mesh/export/export.h"

namespace sgm {

Result<void> writeGlb(const WorldMesh& mesh, const ExportInfo& info, FileWriter& file);
Result<void> writePly(const WorldMesh& mesh, const ExportInfo& info, FileWriter& file);
Result<void> writeStl(const WorldMesh& mesh, const ExportInfo& info, FileWriter& file);
/// library_name is what the file calls the library.
Result<void> writeObj(const WorldMesh& mesh, const ExportInfo& info, const std::string& library_name,
                      FileWriter& library, FileWriter& file);
/// The file name of the materials of an .obj. Many readers end a name at a blank and know no other letters than those
/// of ASCII: a name with such characters is replaced by one that differs for each.
std::string materialLibraryName(const std::filesystem::path& obj);
/// Error: Code::io where something stands there that writeObj has not written.
Result<void> mayReplaceLibrary(const std::filesystem::path& library);

using Float3 = std::array<float, 3>;

Float3 exportedPosition(const WorldMesh& mesh, uint32_t vertex);
Float3 exportedNormal(const WorldMesh& mesh, uint32_t vertex);
uint16_t triangleMaterial(const WorldMesh& mesh, size_t first_index);
ExportMaterial materialAt(const ExportInfo& info, uint16_t index);
/// Shortest text that reads back as the same number, in any locale.
std::string decimalText(float value);
std::string decimalText(double value);
/// Line breaks and other control characters become spaces, so that a name stays within its line.
std::string oneLine(std::string text);

}  // namespace sgm

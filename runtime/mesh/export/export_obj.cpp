// Wavefront OBJ and its material library.

#include "base/file_reader.h"
#include "base/hash.h"
#include "mesh/export/export_formats.h"

namespace sgm {
namespace {

/// The beginning of the second line of a .mtl, which identifies files that this library wrote. The first line names the
/// generator.
constexpr const char* kSecondLine = "# origin_units ";

/// Returns the name of a material without white space, because many readers end the names in usemtl and newmtl at white
/// space.
std::string materialWord(const ExportInfo& info, uint16_t index) {
  std::string word = oneLine(materialAt(info, index).name);
  for (char& c : word)
    if (c == ' ') c = '_';
  return word.empty() ? "material_" + std::to_string(index) : word;
}

/// Returns the materials that the mesh uses, ascending.
std::vector<uint16_t> usedMaterials(const WorldMesh& mesh) {
  std::vector<bool> used(size_t{1} << 16);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) used[triangleMaterial(mesh, i)] = true;
  std::vector<uint16_t> list;
  for (size_t m = 0; m < used.size(); ++m)
    if (used[m]) list.push_back(static_cast<uint16_t>(m));
  return list;
}

void writeVector(FileWriter& file, const char* keyword, const Float3& v) {
  file.write(keyword + decimalText(v[0]) + ' ' + decimalText(v[1]) + ' ' + decimalText(v[2]) + '\n');
}

}  // namespace

Result<void> writeObj(const WorldMesh& mesh, const ExportInfo& info, const std::string& library_name,
                      FileWriter& library, FileWriter& file) {
  const std::string header = "# " + oneLine(info.generator) + '\n' + kSecondLine + std::to_string(mesh.origin.x) + ' ' +
                             std::to_string(mesh.origin.y) + ' ' + std::to_string(mesh.origin.z) + " of 1/" +
                             std::to_string(kUnitsPerMetre) + " m\n";
  library.write(header);
  file.write(header + "mtllib " + library_name + "\no " + oneLine(info.name) + '\n');
  for (uint32_t i = 0; i < mesh.positions.size(); ++i) writeVector(file, "v ", exportedPosition(mesh, i));
  for (uint32_t i = 0; i < mesh.positions.size(); ++i) writeVector(file, "vn ", exportedNormal(mesh, i));
  const ExportTexture* texture = info.texture;
  for (size_t i = 0; texture != nullptr && i < texture->coordinates.size(); ++i) {
    const auto& [u, v] = texture->coordinates[i];
    file.write("vt " + decimalText(u) + ' ' + decimalText(v) + '\n');
  }
  for (uint16_t m : usedMaterials(mesh)) {
    const ExportMaterial material = materialAt(info, m);
    library.write("newmtl " + materialWord(info, m) + '\n');
    writeVector(library, "Kd ", material.colour);
    library.write("Pr " + decimalText(material.roughness) + '\n');
    file.write("usemtl " + materialWord(info, m) + '\n');
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      if (triangleMaterial(mesh, i) != m) continue;
      std::string line = "f";
      for (size_t corner = 0; corner < 3; ++corner) {
        const std::string number = std::to_string(size_t{mesh.indices[i + corner]} + 1);
        const std::string place = texture != nullptr ? std::to_string(size_t{texture->corners[i + corner]} + 1) : "";
        line += ' ' + number + '/' + place + '/' + number;
      }
      file.write(line + '\n');
    }
  }
  // Completes both files on the disk before it gives either of them its final name. The .mtl is renamed first, so that
  // the .obj never refers to a missing .mtl.
  if (Result<void> done = library.finish(); !done) return done;
  if (Result<void> done = file.finish(); !done) return done;
  if (Result<void> done = library.commitReversibly(); !done) return done;
  Result<void> done = file.commit();
  if (!done) library.undo();
  return done;
}

std::string materialLibraryName(const std::filesystem::path& obj) {
  const std::string stem = obj.stem().string();
  std::string name = stem;
  for (char& c : name) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_';
    if (!plain) c = '_';
  }
  if (name == stem) return name + ".mtl";
  // Different names may have become equal by the replacement of characters, so a hash of the original name is appended.
  constexpr char kDigits[] = "0123456789abcdef";
  name += '_';
  const uint64_t hash = hashText(stem);
  for (unsigned shift = 0; shift < 32; shift += 4) name += kDigits[hash >> shift & 15];
  return name + ".mtl";
}

Result<void> mayReplaceLibrary(const std::filesystem::path& library) {
  const Result<std::string> start = readBeginning(library, 4096);
  // An unreadable or empty file is accepted: replacing an empty file loses nothing, and FileWriter reports why a file
  // cannot be read.
  if (!start || start->empty()) return {};
  const size_t second = start->find('\n') + 1;
  if (start->starts_with("# ") && start->substr(second).starts_with(kSecondLine)) return {};
  return Error{Code::io, "cannot write '" + library.string() +
                             "', the materials of the .obj file: a file that sgm did not write is there; move it away "
                             "or choose another name"};
}

}  // namespace sgm

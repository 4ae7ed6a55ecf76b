// Wavefront OBJ and its material library.

#include "mesh/export_formats.h"
#include "mesh/file_writer.h"

namespace sgm {
namespace {

/// usemtl and newmtl end a name at white space in many readers.
std::string materialWord(const ExportInfo& info, uint16_t index) {
  std::string word = oneLine(materialAt(info, index).name);
  for (char& c : word)
    if (c == ' ') c = '_';
  return word.empty() ? "material_" + std::to_string(index) : word;
}

/// Triangles in groups of one material; within a group in the mesh's order.
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

Result<void> writeObj(const WorldMesh& mesh, const ExportInfo& info, const std::filesystem::path& path) {
  const std::filesystem::path library_path = std::filesystem::path(path).replace_extension(".mtl");
  Result<FileWriter> library = FileWriter::create(library_path);
  if (!library) return library.error();
  Result<FileWriter> file = FileWriter::create(path);
  if (!file) return file.error();

  const std::string header = "# " + oneLine(info.generator) + "\n# origin_units " + std::to_string(mesh.origin.x) +
                             ' ' + std::to_string(mesh.origin.y) + ' ' + std::to_string(mesh.origin.z) + " of 1/" +
                             std::to_string(kUnitsPerMetre) + " m\n";
  library->write(header);
  file->write(header + "mtllib " + library_path.filename().string() + "\no " + oneLine(info.name) + '\n');
  for (uint32_t i = 0; i < mesh.positions.size(); ++i) writeVector(*file, "v ", exportedPosition(mesh, i));
  for (uint32_t i = 0; i < mesh.positions.size(); ++i) writeVector(*file, "vn ", exportedNormal(mesh, i));
  for (uint16_t m : usedMaterials(mesh)) {
    const ExportMaterial material = materialAt(info, m);
    library->write("newmtl " + materialWord(info, m) + '\n');
    writeVector(*library, "Kd ", material.colour);
    library->write("Pr " + decimalText(material.roughness) + '\n');
    file->write("usemtl " + materialWord(info, m) + '\n');
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      if (triangleMaterial(mesh, i) != m) continue;
      std::string line = "f";
      for (size_t corner = 0; corner < 3; ++corner) {
        const std::string number = std::to_string(size_t{mesh.indices[i + corner]} + 1);
        line += ' ' + number + "//" + number;
      }
      file->write(line + '\n');
    }
  }
  // Both are whole on the disk before either takes its name.
  if (Result<void> done = file->finish(); !done) return done;
  if (Result<void> done = library->commit(); !done) return done;
  return file->commit();
}

}  // namespace sgm

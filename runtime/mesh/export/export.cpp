#include "mesh/export/export.h"

#include <charconv>

#include "mesh/export/export_formats.h"
#include "mesh/vertex.h"

namespace sgm {

Result<MeshFormat> meshFormatOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (extension == ".glb") return MeshFormat::glb;
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".stl") return MeshFormat::stl;
  return Error{Code::invalid_argument,
               path.string() + ": the mesh format is unsupported; end the name in .glb, .obj, .ply or .stl"};
}

Result<MeshFile> MeshFile::create(const std::filesystem::path& path, UnfinishedFiles* unfinished) {
  const Result<MeshFormat> format = meshFormatOf(path);
  if (!format) return format.error();
  MeshFile file(*format);
  file.paths_.push_back(path);
  if (*format == MeshFormat::obj) {
    file.paths_.push_back(std::filesystem::path(path).replace_filename(materialLibraryName(path)));
    if (Result<void> may = mayReplaceLibrary(file.paths_.back()); !may) return may.error();
  }
  for (const std::filesystem::path& one : file.paths_) {
    Result<FileWriter> writer = FileWriter::create(one, unfinished);
    if (!writer) return writer.error();
    file.files_.push_back(std::move(*writer));
  }
  return file;
}

Result<void> MeshFile::write(const WorldMesh& mesh, const ExportInfo& info) {
  switch (format_) {
    case MeshFormat::glb:
      return writeGlb(mesh, info, files_[0]);
    case MeshFormat::obj:
      return writeObj(mesh, info, paths_[1].filename().string(), files_[1], files_[0]);
    case MeshFormat::ply:
      return writePly(mesh, info, files_[0]);
    case MeshFormat::stl:
      return writeStl(mesh, info, files_[0]);
  }
  return Error{Code::invalid_argument, "the mesh format is unknown"};
}

uint64_t MeshFile::bytes() const {
  uint64_t sum = 0;
  for (const FileWriter& file : files_) sum += file.bytes();
  return sum;
}

Result<void> exportMesh(const WorldMesh& mesh, const ExportInfo& info, const std::filesystem::path& path) {
  Result<MeshFile> file = MeshFile::create(path);
  if (!file) return file.error();
  return file->write(mesh, info);
}

bool MeshFile::holdsTexture(const std::filesystem::path& path) {
  const Result<MeshFormat> format = meshFormatOf(path);
  return format && (*format == MeshFormat::glb || *format == MeshFormat::obj);
}

Float3 exportedPosition(const WorldMesh& mesh, uint32_t vertex) {
  const std::array<double, 3>& p = mesh.positions[vertex];
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

Float3 exportedNormal(const WorldMesh& mesh, uint32_t vertex) {
  const VertexAttributes& a = mesh.attributes[vertex];
  const std::array<double, 3> n = unpackNormal(a.normal_x, a.normal_y);
  return {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])};
}

uint16_t triangleMaterial(const WorldMesh& mesh, size_t first_index) {
  const auto at = [&](size_t corner) { return mesh.attributes[mesh.indices[first_index + corner]].material; };
  return at(1) == at(2) ? at(1) : at(0);
}

ExportMaterial materialAt(const ExportInfo& info, uint16_t index) {
  if (index < info.materials.size()) return info.materials[index];
  ExportMaterial unknown;
  unknown.name = "material " + std::to_string(index);
  return unknown;
}

namespace {

template <class T>
std::string shortest(T value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

}  // namespace

std::string decimalText(float value) { return shortest(value); }
std::string decimalText(double value) { return shortest(value); }

std::string oneLine(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  return text;
}

}  // namespace sgm

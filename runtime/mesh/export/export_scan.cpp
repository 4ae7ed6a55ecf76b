// The two binary formats of scanning and printing: PLY and STL.

#include <cmath>
#include <limits>

#include "base/math.h"
#include "mesh/export/export_formats.h"

namespace sgm {
namespace {

/// Converts a linear colour to the sRGB bytes that viewers of PLY files expect.
std::array<uint8_t, 3> displayColour(const std::array<float, 3>& linear) {
  std::array<uint8_t, 3> bytes{};
  for (size_t i = 0; i < 3; ++i) {
    const double c = std::fmin(std::fmax(static_cast<double>(linear[i]), 0.0), 1.0);
    const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * detPow(c, 1 / 2.4) - 0.055;
    bytes[i] = static_cast<uint8_t>(s * 255 + 0.5);
  }
  return bytes;
}

Error tooLarge(const char* format) {
  return {Code::limit, std::string("the mesh has more triangles or vertices than a ") + format + " file can number"};
}

}  // namespace

Result<void> writePly(const WorldMesh& mesh, const ExportInfo& info, FileWriter& file) {
  if (mesh.positions.size() > static_cast<size_t>(std::numeric_limits<int32_t>::max())) return tooLarge(".ply");
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment " + oneLine(info.generator) +
                       "\ncomment origin_units " + std::to_string(mesh.origin.x) + ' ' + std::to_string(mesh.origin.y) +
                       ' ' + std::to_string(mesh.origin.z) + " of 1/" + std::to_string(kUnitsPerMetre) + " m\n";
  for (size_t i = 0; i < info.materials.size(); ++i)
    header += "comment material " + std::to_string(i) + ' ' + oneLine(info.materials[i].name) + '\n';
  for (size_t i = 0; i < info.tags.size(); ++i)
    header += "comment tag " + std::to_string(i) + ' ' + oneLine(info.tags[i]) + '\n';
  header += "element vertex " + std::to_string(mesh.positions.size()) + '\n';
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) header += std::string("property float ") + name + '\n';
  for (const char* name : {"red", "green", "blue"}) header += std::string("property uchar ") + name + '\n';
  header += "property ushort material\nproperty ushort tag\nelement face " + std::to_string(mesh.indices.size() / 3) +
            "\nproperty list uchar int vertex_indices\nend_header\n";
  file.write(header);

  std::vector<std::array<uint8_t, 3>> colours;
  for (const ExportMaterial& m : info.materials) colours.push_back(displayColour(m.colour));
  const std::array<uint8_t, 3> grey = displayColour(ExportMaterial{}.colour);
  for (uint32_t i = 0; i < mesh.positions.size(); ++i) {
    const Float3 position = exportedPosition(mesh, i), normal = exportedNormal(mesh, i);
    const VertexAttributes& a = mesh.attributes[i];
    const std::array<uint8_t, 3>& colour = a.material < colours.size() ? colours[a.material] : grey;
    file.write(position.data(), sizeof position);
    file.write(normal.data(), sizeof normal);
    file.write(colour.data(), sizeof colour);
    file.writeValue(a.material);
    file.writeValue(a.tag);
  }
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    file.writeValue(uint8_t{3});
    file.write(&mesh.indices[i], 3 * sizeof(uint32_t));
  }
  return file.commit();
}

Result<void> writeStl(const WorldMesh& mesh, const ExportInfo& info, FileWriter& file) {
  if (mesh.indices.size() / 3 > std::numeric_limits<uint32_t>::max()) return tooLarge(".stl");
  // The header must not begin with "solid": readers would treat the file as text.
  std::string header = "binary STL, " + oneLine(info.generator) + ", origin_units " + std::to_string(mesh.origin.x) +
                       ' ' + std::to_string(mesh.origin.y) + ' ' + std::to_string(mesh.origin.z);
  header.resize(80, ' ');
  file.write(header);
  file.writeValue(static_cast<uint32_t>(mesh.indices.size() / 3));
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::array<double, 3>&a = mesh.positions[mesh.indices[i]], &b = mesh.positions[mesh.indices[i + 1]],
                             &c = mesh.positions[mesh.indices[i + 2]];
    std::array<double, 3> n{};
    for (size_t k = 0; k < 3; ++k) {
      const size_t u = (k + 1) % 3, v = (k + 2) % 3;
      n[k] = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
    }
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (double x : n) file.writeValue(length > 0 ? static_cast<float>(x / length) : 0.0f);
    for (size_t corner = 0; corner < 3; ++corner) {
      const Float3 position = exportedPosition(mesh, mesh.indices[i + corner]);
      file.write(position.data(), sizeof position);
    }
    file.writeValue(uint16_t{0});
  }
  return file.commit();
}

}  // namespace sgm

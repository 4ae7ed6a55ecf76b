#include "cli/measured_mesh.h"

#include <fmt/core.h>

#include <filesystem>
#include <fstream>

namespace sgm::cli {
namespace {

Result<std::vector<std::byte>> readBytes(const std::string& path) {
  std::error_code why;
  const uintmax_t size = std::filesystem::is_regular_file(path, why) ? std::filesystem::file_size(path, why) : 0;
  std::ifstream file(path, std::ios::binary);
  if (why || !file || !std::filesystem::is_regular_file(path, why)) {
    return Error{Code::io, fmt::format("cannot read {}", path)};
  }
  std::vector<std::byte> bytes(size);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (file.gcount() != static_cast<std::streamsize>(size)) return Error{Code::io, fmt::format("cannot read {}", path)};
  return bytes;
}

}  // namespace

Result<asset::TriangleMesh> readMeshFile(const std::string& file, asset::MeshFileKind kind) {
  const Result<std::vector<std::byte>> bytes = readBytes(file);
  if (!bytes) return bytes.error();
  Result<asset::TriangleMesh> mesh = asset::readMesh(*bytes, kind);
  if (!mesh) return Error{mesh.error().code, file + ": " + mesh.error().message};
  return mesh;
}

asset::TriangleMesh trianglesOf(const Region& region) {
  const WorldMesh& mesh = region.unsplit ? *region.unsplit : region.meshed.mesh;
  asset::TriangleMesh triangles;
  triangles.points.reserve(mesh.positions.size());
  for (const std::array<double, 3>& p : mesh.positions) triangles.points.push_back({p[0], p[1], p[2]});
  triangles.triangles.reserve(mesh.indices.size() / 3);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    triangles.triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
  }
  return triangles;
}

}  // namespace sgm::cli

#include "cli/measured_mesh.h"

#include <fmt/core.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "measure/world_triangles.h"

namespace sgm::cli {
namespace {

Result<std::vector<std::byte>> readBytes(const std::string& path) {
  const auto failed = [&](const std::string& why) {
    return Error{Code::io, fmt::format("cannot read {}: {}", path, why)};
  };
  std::error_code why;
  const std::filesystem::file_status status = std::filesystem::status(path, why);
  // Whatever else it may be, a pipe say, would be waited for.
  if (!std::filesystem::exists(status)) return failed(why ? why.message() : "no such file");
  if (!std::filesystem::is_regular_file(status)) return failed("it is no file of bytes");
  const uintmax_t size = std::filesystem::file_size(path, why);
  std::ifstream file(path, std::ios::binary);
  if (why || !file) return failed(why ? why.message() : std::strerror(errno));
  std::vector<std::byte> bytes(size);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (file.gcount() != static_cast<std::streamsize>(size)) return failed("it ended before its size");
  return bytes;
}

}  // namespace

Result<asset::TriangleMesh> readMeshFile(const std::string& file, asset::MeshFileKind kind) {
  const Result<std::vector<std::byte>> bytes = readBytes(file);
  if (!bytes) return bytes.error();
  // What a file may hold is limited by the process's memory alone.
  asset::MeshLimits limits;
  limits.points = limits.triangles = std::numeric_limits<uint32_t>::max();
  limits.farthest = 1e12;
  limits.json_bytes = size_t{64} << 20;
  limits.nodes = size_t{1} << 20;
  Result<asset::TriangleMesh> mesh = asset::readMesh(*bytes, kind, limits);
  if (!mesh) return Error{mesh.error().code, file + ": " + mesh.error().message};
  return mesh;
}

asset::TriangleMesh trianglesOf(const Region& region) {
  return measure::trianglesOf(region.unsplit ? *region.unsplit : region.meshed.mesh);
}

}  // namespace sgm::cli

#include "tools/support/measured_mesh.h"

#include <fmt/core.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>
#include <type_traits>

#include "base/file_reader.h"
#include "measure/world_triangles.h"

namespace sgm::cli {
namespace {

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (!values.empty()) bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// Copies values from the front of `bytes`, and removes these bytes. Returns false if there are too few bytes.
template <class T>
bool take(std::string_view& bytes, std::vector<T>& values) {
  const size_t size = values.size() * sizeof(T);
  if (bytes.size() < size) return false;
  if (size > 0) std::memcpy(values.data(), bytes.data(), size);
  bytes.remove_prefix(size);
  return true;
}

}  // namespace

bool isGrammarFile(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return ending == ".sgm";
}

Result<asset::TriangleMesh> readMeshBytes(std::span<const std::byte> bytes, std::optional<asset::MeshFileKind> kind) {
  // No limit for points and triangles: the file is limited only by the memory of the process.
  asset::MeshLimits limits;
  limits.points = limits.triangles = std::numeric_limits<uint32_t>::max();
  limits.farthest = 1e12;
  limits.json_bytes = size_t{64} << 20;
  limits.nodes = size_t{1} << 20;
  return asset::readMesh(bytes, kind, limits);
}

Result<asset::TriangleMesh> readMeshFile(const std::string& file) {
  // readFile() rejects pipes, because reading one might block.
  const Result<std::string> bytes = readFile(file, UINT64_MAX);
  if (!bytes) return bytes.error();
  // If the file name does not tell the format, readMesh() detects it from the content.
  const Result<asset::MeshFileKind> named = asset::meshFileKind(std::string_view(file));
  Result<asset::TriangleMesh> mesh =
      readMeshBytes(std::as_bytes(std::span(*bytes)), named ? std::optional(*named) : std::nullopt);
  if (!mesh) return Error{mesh.error().code, file + ": " + mesh.error().message};
  for (const std::string& note : mesh->notes) fmt::print(stderr, "sgm: note: {}: {}\n", file, note);
  return mesh;
}

Result<std::string> meshFileAnswer(const std::string& file) {
  const Result<asset::TriangleMesh> mesh = readMeshFile(file);
  if (!mesh) return mesh.error();
  std::string bytes;
  append(bytes, std::vector<uint64_t>{mesh->points.size(), mesh->triangles.size()});
  append(bytes, std::vector<asset::Point>{mesh->origin});
  append(bytes, mesh->points);
  append(bytes, mesh->triangles);
  return bytes;
}

Result<asset::TriangleMesh> askSandboxForMesh(const std::string& file, const SandboxOptions& options) {
  const Result<std::string> said = askSandbox(options);
  if (!said) return said.error();
  // The file may have compromised the process that reads it, so check the lengths in the answer against the number of
  // bytes.
  std::string_view left = *said;
  std::vector<uint64_t> counts(2);
  std::vector<asset::Point> origin(1);
  asset::TriangleMesh mesh;
  bool whole = take(left, counts) && take(left, origin) && counts[0] <= left.size() && counts[1] <= left.size();
  if (whole) {
    mesh.origin = origin.front();
    mesh.points.resize(counts[0]);
    mesh.triangles.resize(counts[1]);
    whole = take(left, mesh.points) && take(left, mesh.triangles) && left.empty();
  }
  for (const auto& triangle : mesh.triangles)
    for (const uint32_t corner : triangle) whole = whole && corner < mesh.points.size();
  if (!whole) return Error{Code::io, "the process that read " + file + " returned something other than a mesh"};
  return mesh;
}

measure::Cut cutOf(const Region& region) {
  measure::Cut cut;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t origin = region.meshed.mesh.origin[axis];
    cut.low[axis] = static_cast<double>(region.meshed.extent.lo[axis] - origin) / kUnitsPerMetre;
    cut.high[axis] = static_cast<double>(region.meshed.extent.hi[axis] - origin) / kUnitsPerMetre;
  }
  return cut;
}

asset::TriangleMesh trianglesOf(const Region& region) {
  return measure::trianglesOf(region.unsplit ? *region.unsplit : region.meshed.mesh);
}

}  // namespace sgm::cli

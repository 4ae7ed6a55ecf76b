#include "tools/cli/classify/page_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace sgm::cli {
namespace {

using Position = std::array<float, 3>;

/// Triangles with a coordinate of larger magnitude are ignored, like those with a coordinate that is not finite; `sgm
/// measure` does the same.
constexpr double kFarthest = 1e37;

bool isPlace(const asset::Point& p) {
  return std::fabs(p.x) <= kFarthest && std::fabs(p.y) <= kFarthest && std::fabs(p.z) <= kFarthest;
}

/// Keeps every n-th triangle of a mesh that simplification cannot reduce to kMaxPreviewTriangles.
void thinOut(std::vector<uint32_t>& indices) {
  const size_t count = indices.size() / 3, step = (count + kMaxPreviewTriangles - 1) / kMaxPreviewTriangles;
  size_t kept = 0;
  for (size_t i = 0; i < count; i += step, ++kept)
    std::copy_n(indices.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                indices.begin() + static_cast<std::ptrdiff_t>(3 * kept));
  indices.resize(3 * kept);
}

/// Merges points at the same position. Otherwise the simplifier would take them for the two sides of a seam, and it
/// must not move seams: it could not collapse any edge of a mesh whose triangles share no points.
void weld(std::vector<uint32_t>& indices, std::vector<Position>& positions) {
  std::vector<uint32_t> remap(positions.size());
  const size_t count = meshopt_generateVertexRemap(remap.data(), indices.data(), indices.size(), positions.data(),
                                                   positions.size(), sizeof(Position));
  std::vector<Position> welded(count);
  meshopt_remapVertexBuffer(welded.data(), positions.data(), positions.size(), sizeof(Position), remap.data());
  meshopt_remapIndexBuffer(indices.data(), indices.data(), indices.size(), remap.data());
  positions = std::move(welded);
}

Position cross(const Position& a, const Position& b, const Position& c) {
  const Position u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// For each point, the sum of its triangles' normals, weighted by their areas.
std::vector<Position> normalsOf(const std::vector<uint32_t>& indices, const std::vector<Position>& positions) {
  std::vector<Position> normals(positions.size(), Position{});
  for (size_t i = 0; i < indices.size(); i += 3) {
    const Position n = cross(positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]);
    for (size_t corner = 0; corner < 3; ++corner)
      for (size_t axis = 0; axis < 3; ++axis) normals[indices[i + corner]][axis] += n[axis];
  }
  return normals;
}

/// Removes triangles whose orientation the simplifier has reversed: other triangles cover the surface there.
void dropFolded(std::vector<uint32_t>& indices, const std::vector<Position>& positions,
                const std::vector<Position>& normals) {
  size_t kept = 0;
  for (size_t i = 0; i < indices.size(); i += 3) {
    const Position n = cross(positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]);
    float along = 0;
    for (size_t corner = 0; corner < 3; ++corner)
      for (size_t axis = 0; axis < 3; ++axis) along += n[axis] * normals[indices[i + corner]][axis];
    if (along < 0) continue;
    for (size_t corner = 0; corner < 3; ++corner) indices[kept++] = indices[i + corner];
  }
  if (kept > 0) indices.resize(kept);
}

/// First collapses edges, because this rarely reverses a triangle. If too many triangles remain, since the mesh has
/// many separate parts, its points are clustered instead. This reduces some parts to tiny remnants.
void simplify(std::vector<uint32_t>& indices, std::vector<Position>& positions) {
  constexpr size_t kMost = 3 * kMaxPreviewTriangles;
  constexpr float kAnyError = 1;
  weld(indices, positions);
  std::vector<uint32_t> fewer(indices.size());
  size_t size = meshopt_simplify(fewer.data(), indices.data(), indices.size(), positions[0].data(), positions.size(),
                                 sizeof(Position), kMost, kAnyError, 0, nullptr);
  if (size == 0 || size > kMost)
    size = meshopt_simplifySloppy(fewer.data(), indices.data(), indices.size(), positions[0].data(), positions.size(),
                                  sizeof(Position), kMost, kAnyError, nullptr);
  if (size == 0 || size > kMost) return thinOut(indices);
  fewer.resize(size);
  dropFolded(fewer, positions, normalsOf(indices, positions));
  indices = std::move(fewer);
}

void append(std::string& bytes, uint32_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift);
}

}  // namespace

Preview previewOf(const asset::TriangleMesh& mesh) {
  Preview preview;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  asset::Point low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  std::vector<uint32_t> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    if (!std::ranges::all_of(triangle, [&](uint32_t corner) { return isPlace(mesh.points[corner]); })) continue;
    indices.insert(indices.end(), triangle.begin(), triangle.end());
    for (const uint32_t corner : triangle) {
      const asset::Point& p = mesh.points[corner];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  if (indices.empty()) return preview;
  const asset::Point centre = 0.5 * (low + high);
  preview.origin = mesh.origin + centre;
  std::vector<Position> positions(mesh.points.size());
  for (size_t i = 0; i < positions.size(); ++i) {
    const asset::Point p = isPlace(mesh.points[i]) ? mesh.points[i] - centre : asset::Point{};
    positions[i] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  if (indices.size() > 3 * kMaxPreviewTriangles) simplify(indices, positions);
  preview.positions.resize(positions.size());
  const size_t used = meshopt_optimizeVertexFetch(preview.positions.data(), indices.data(), indices.size(),
                                                  positions.data(), positions.size(), sizeof(Position));
  preview.positions.resize(used);
  preview.indices = std::move(indices);
  preview.low = preview.high = preview.positions[0];
  for (const Position& p : preview.positions) {
    for (size_t axis = 0; axis < 3; ++axis) {
      preview.low[axis] = std::min(preview.low[axis], p[axis]);
      preview.high[axis] = std::max(preview.high[axis], p[axis]);
    }
  }
  return preview;
}

std::string bytesOf(const Preview& preview) {
  std::string bytes = "SGMPREV1";
  bytes.reserve(16 + 12 * preview.positions.size() + 4 * preview.indices.size());
  append(bytes, static_cast<uint32_t>(preview.positions.size()));
  append(bytes, static_cast<uint32_t>(preview.indices.size() / 3));
  for (const Position& p : preview.positions)
    for (const float x : p) append(bytes, std::bit_cast<uint32_t>(x));
  for (const uint32_t index : preview.indices) append(bytes, index);
  return bytes;
}

}  // namespace sgm::cli

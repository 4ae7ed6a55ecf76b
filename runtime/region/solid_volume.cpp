#include "region/solid_volume.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "field/evaluate.h"

namespace sgm {
namespace {

constexpr size_t kChunksTogether = 4096;  ///< number of chunks whose meshes are in memory at the same time

/// Returns the faces of a chunk that lie in the upper borders of the region, as a mask. Faces in the lower borders are
/// not needed: position vectors start at the region's lowest corner, so the flux of positions through the lower borders
/// is 0.
uint8_t upperFaces(const ChunkKey& key, const ChunkKey& last) {
  uint8_t faces = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (key.at[axis] == last.at[axis]) faces |= static_cast<uint8_t>(1 << (2 * axis + 1));
  return faces;
}

/// True if a sample at this position is solid, by the rule that meshing uses.
Result<bool> isSolidAt(const WorldField& world, Int3 at, int level) {
  const auto program = world.compile(IntBox{at, at}, level);
  if (!program) return program.error();
  EvalScratch scratch;
  float value = 0;
  Attributes wanted;
  wanted.value = &value;
  scalarKernels().attributes((*program)->view(), {&at.x, &at.y, &at.z, 1}, scratch, wanted);
  return std::floor(value * (*program)->q_scale + 0.5f) < 0;
}

/// Measures how much of the upper faces of a region is solid. Computes the area by Green's theorem from the open edges
/// of the surface in these faces.
class UpperFaces {
 public:
  UpperFaces(const IntBox& region, const WorldMesh& mesh) : mesh_(mesh) {
    for (int k = 0; k < 3; ++k) {
      size_[index(k)] = static_cast<double>(int64_t{region.hi[k]} - region.lo[k]) / kUnitsPerMetre;
      low_[index(k)] = static_cast<double>(int64_t{region.lo[k]} - mesh.origin[k]) / kUnitsPerMetre;
    }
  }

  /// Returns the area, in m2, of the solid part of the upper face perpendicular to an axis. corner_is_solid: true if
  /// the region is solid at its highest corner, where the three upper faces meet.
  double solidArea(int axis, bool corner_is_solid) const {
    const size_t k = index(axis), u = index((axis + 1) % 3), v = index((axis + 2) % 3);
    double area = 0;
    for (size_t i = 0; i < mesh_.indices.size(); ++i) {
      const uint32_t from = mesh_.indices[i], to = mesh_.indices[i % 3 == 2 ? i - 2 : i + 1];
      const std::array<double, 3> a = place(from), b = place(to);
      if (a[k] != size_[k] || b[k] != size_[k]) continue;
      // By Green's theorem, the area is a line integral along the boundary of the solid part. The surface's open edges
      // run along this boundary in the opposite direction, so their integral is subtracted.
      area -= (a[u] + b[u]) / 2 * (b[v] - a[v]);
    }
    return area + size_[u] * solidLength(k, u, v, corner_is_solid);
  }

  double size(int axis) const { return size_[index(axis)]; }

 private:
  static size_t index(int axis) { return static_cast<size_t>(axis); }

  /// Returns the position of a vertex relative to the region's lowest corner, in metres. Exact, since positions and
  /// cells are multiples of 1/2^18 m.
  std::array<double, 3> place(uint32_t vertex) const {
    const std::array<double, 3>& p = mesh_.positions[vertex];
    return {p[0] - low_[0], p[1] - low_[1], p[2] - low_[2]};
  }

  /// Returns the total length, in metres, of the solid parts of one edge of the region. The edge runs along v, between
  /// the upper faces perpendicular to k and to u. is_solid: true if the region is solid at the high end of this edge.
  double solidLength(size_t k, size_t u, size_t v, bool is_solid) const {
    std::vector<double> crossings;
    for (uint32_t i = 0; i < mesh_.positions.size(); ++i) {
      const std::array<double, 3> p = place(i);
      if (p[k] == size_[k] && p[u] == size_[u]) crossings.push_back(p[v]);
    }
    std::sort(crossings.begin(), crossings.end(), std::greater<>());
    crossings.push_back(0);
    double length = 0, from = size_[v];
    for (const double at : crossings) {
      if (is_solid) length += from - at;
      from = at;
      is_solid = !is_solid;
    }
    return length;
  }

  const WorldMesh& mesh_;
  std::array<double, 3> size_{};  ///< extent of the region in metres
  std::array<double, 3> low_{};   ///< the region's lowest corner, relative to the origin of positions, in metres
};

}  // namespace

std::array<double, 3> originFrom(Int3 place, const ChunkGrid& grid) {
  std::array<double, 3> from{};
  for (int axis = 0; axis < 3; ++axis)
    from[static_cast<size_t>(axis)] = static_cast<double>(int64_t{grid.origin[axis]} - place[axis]) / kUnitsPerMetre;
  return from;
}

Result<double> borderFlux(const WorldField& world, Backend& backend, JobSystem& jobs, std::span<const ChunkKey> keys,
                          bool sharp) {
  const Result<ChunkGrid> lowest = chunkGrid(world, keys.front());
  if (!lowest) return lowest.error();
  std::pmr::vector<ChunkRequest> requests(world.memory());
  for (const ChunkKey& key : keys) {
    const uint8_t faces = upperFaces(key, keys.back());
    if (faces == 0) continue;
    // Requests a seam between each outermost chunk and a virtual neighbour beyond the region. The neighbour is entirely
    // solid or entirely void, like the domain. If the domain is void, the seam covers the part of the chunk's face
    // where the region's border cuts the solid. If the domain is solid, the seam covers the part where the border cuts
    // the void.
    ChunkRequest& request = requests.emplace_back(ChunkRequest{key, faces});
    request.outermost = true;
    request.sharp = sharp;
    request.body = false;
    request.keys = sharp;
    request.sums_only = !sharp;
  }
  double flux = 0;
  for (size_t first = 0; first < requests.size(); first += kChunksTogether) {
    const auto together = std::span(requests).subspan(first, std::min(kChunksTogether, requests.size() - first));
    const Result<std::pmr::vector<PlacedChunk>> chunks = meshChunks(world, backend, jobs, together);
    if (!chunks) return chunks.error();
    for (const PlacedChunk& chunk : *chunks) {
      const std::array<double, 3> origin = originFrom(lowest->origin, chunk.grid);
      for (size_t face = 0; face < chunk.mesh.seams.size(); ++face) {
        const MeshPart& seam = chunk.mesh.seams[face];
        flux +=
            fluxOf(sharp ? sumsOf(seam.vertices, seam.indices) : chunk.mesh.sums[1 + face], chunk.grid.cell, origin);
      }
    }
  }
  return flux;
}

Result<double> borderFlux(const WorldField& world, const IntBox& region, int level, const WorldMesh& mesh) {
  const Result<bool> corner_is_solid = isSolidAt(world, region.hi, level);
  if (!corner_is_solid) return corner_is_solid.error();
  const UpperFaces faces(region, mesh);
  double flux = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double area = faces.solidArea(axis, *corner_is_solid);
    // In a solid domain, the surface encloses the void. So this face contributes minus the area of its void, that is,
    // the area of its solid minus the area of the whole face.
    if (world.isSolidDomain()) area -= faces.size((axis + 1) % 3) * faces.size((axis + 2) % 3);
    flux += faces.size(axis) * area / 3;
  }
  return flux;
}

double solidVolume(const WorldField& world, const IntBox& region, double flux) {
  if (!world.isSolidDomain()) return flux;
  // In a solid domain, the computed flux is minus the volume of the void. So the volume of the solid is the volume of
  // the whole region plus this flux.
  double volume = 1;
  for (int axis = 0; axis < 3; ++axis)
    volume *= static_cast<double>(int64_t{region.hi[axis]} - region.lo[axis]) / kUnitsPerMetre;
  return volume + flux;
}

}  // namespace sgm

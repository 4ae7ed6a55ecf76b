#include "region/region.h"

#include <algorithm>
#include <array>
#include <optional>

#include "region/measure.h"
#include "region/solid_volume.h"

namespace sgm {
namespace {

constexpr size_t kCells = kChunkCells;
constexpr uint64_t kCellBits = (uint64_t{1} << kCells) - 1;

/// Returns the number of chunks along each axis. keys: all chunks of a box, in order z, y, x.
std::array<size_t, 3> countsOf(std::span<const ChunkKey> keys) {
  std::array<size_t, 3> counts{};
  for (int axis = 0; axis < 3; ++axis) {
    counts[static_cast<size_t>(axis)] = static_cast<size_t>(keys.back().at[axis] - keys.front().at[axis]) + 1;
  }
  return counts;
}

/// Returns the signs of a row of a chunk's samples, one bit per sample.
uint64_t signsOfRow(const ChunkMesh& mesh, size_t y, size_t z) {
  if (!mesh.signs.empty()) return mesh.signs[y + z * kChunkSamples];
  return mesh.solid_samples > 0 ? ~uint64_t{0} : 0;
}

/// Reads the samples of a layer of chunks plane by plane, and adds the planes to a ComponentCounter. Adds the highest
/// plane of a layer only for the last layer, since otherwise it is the lowest plane of the next layer.
class PlaneReader {
 public:
  PlaneReader(size_t nx, size_t ny, std::pmr::memory_resource* memory)
      : nx_(nx),
        ny_(ny),
        words_(ComponentCounter::rowWords(nx * kCells + 1)),
        counter_(nx * kCells + 1, ny * kCells + 1, memory),
        plane_(words_ * (ny * kCells + 1), memory) {}

  void add(std::span<const PlacedChunk> layer, bool last) {
    for (size_t z = 0; z < kCells + (last ? 1 : 0); ++z) {
      std::fill(plane_.begin(), plane_.end(), 0);
      for (size_t y = 0; y <= ny_ * kCells; ++y) {
        const size_t row_of_chunks = std::min(y / kCells, ny_ - 1);
        uint64_t* row = plane_.data() + y * words_;
        for (size_t x = 0; x < nx_; ++x) {
          const uint64_t signs = signsOfRow(layer[row_of_chunks * nx_ + x].mesh, y - row_of_chunks * kCells, z);
          row[x / 2] |= (signs & kCellBits) << (x % 2 * kCells);
          if (x + 1 == nx_) row[nx_ / 2] |= (signs >> kCells & 1) << (nx_ % 2 * kCells);
        }
      }
      counter_.addPlane(plane_);
    }
  }

  Pieces pieces() const { return counter_.pieces(); }

 private:
  size_t nx_, ny_, words_;
  ComponentCounter counter_;
  std::pmr::vector<uint64_t> plane_;
};

}  // namespace

Result<RegionMeasures> measureRegion(const WorldField& world, Backend& backend, JobSystem& jobs, const IntBox& region,
                                     uint64_t max_chunks, const WantedMeasures& wanted, const Progress& progress) {
  const Result<std::pmr::vector<ChunkKey>> keys = chunksOfRegion(world, region, 0, max_chunks);
  if (!keys) return keys.error();
  const std::array<size_t, 3> counts = countsOf(*keys);
  const size_t in_layer = counts[0] * counts[1];
  std::optional<PlaneReader> planes;
  if (wanted.components) planes.emplace(counts[0], counts[1], world.memory());

  RegionMeasures result;
  result.chunks = keys->size();
  uint64_t solid_samples = 0;
  double flux = 0;
  std::pmr::vector<PlacedChunk> surface(world.memory());
  for (size_t z = 0; z < counts[2]; ++z) {
    std::pmr::vector<ChunkRequest> requests(world.memory());
    for (size_t i = 0; i < in_layer; ++i) requests.push_back({(*keys)[z * in_layer + i], 0, 0, wanted.components});
    for (ChunkRequest& request : requests) request.sums_only = !wanted.topology;
    bool stopped = false;
    const Progress layer_progress = [&](uint64_t done, uint64_t) {
      stopped = progress && !progress(z * in_layer + done, keys->size());
      return !stopped;
    };
    Result<std::pmr::vector<PlacedChunk>> chunks = meshChunks(world, backend, jobs, requests, layer_progress);
    if (!chunks) return chunks.error();
    // If the progress callback cancels after the last chunk of this layer, meshChunks() still succeeds. But then the
    // next layers are missing.
    if (stopped && z + 1 < counts[2]) return Error{Code::cancelled, "meshing was cancelled"};
    if (planes) planes->add(*chunks, z + 1 == counts[2]);
    if (z == 0) result.extent.lo = chunks->front().grid.origin;
    result.extent.hi = chunks->back().grid.origin;
    for (PlacedChunk& chunk : *chunks) {
      const MeshPart& body = chunk.mesh.body;
      const PartSums sums = wanted.topology ? sumsOf(body.vertices, body.indices) : chunk.mesh.sums[0];
      result.triangles += sums.triangles;
      result.area += areaOf(sums, chunk.grid.cell);
      flux += fluxOf(sums, chunk.grid.cell, originFrom(result.extent.lo, chunk.grid));
      solid_samples += chunk.mesh.solid_samples;
      if (body.indices.empty()) continue;
      chunk.mesh.signs = {};
      surface.push_back(std::move(chunk));
    }
  }
  const int32_t cell = world.settings().finest_cell;
  for (int axis = 0; axis < 3; ++axis) result.extent.hi[axis] += kChunkCells * cell;
  if (wanted.volume) {
    const Result<double> border = borderFlux(world, backend, jobs, *keys, false);
    if (!border) return border.error();
    result.volume = solidVolume(world, result.extent, flux + *border);
  }
  result.cubes = cubeVolume(solid_samples, cell);
  result.sample = cubeVolume(1, cell);
  result.cell = cell;
  if (planes) result.pieces = planes->pieces();
  if (!wanted.topology) return result;

  std::pmr::vector<PlacedPart> parts(world.memory());
  for (const PlacedChunk& chunk : surface) appendParts(chunk, parts);
  const Result<WorldMesh> mesh = weld(parts, result.extent.lo, world.memory());
  if (!mesh) return mesh.error();
  surface.clear();
  result.topology = topologyOf(*mesh, result.extent);
  return result;
}

}  // namespace sgm

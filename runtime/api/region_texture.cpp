#include "api/region_texture.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "mesh/chunk.h"
#include "mesh/vertex.h"
#include "stream/surface_materials.h"
#include "stream/surface_shapes.h"

namespace sgm::api {
namespace {

/// A vertex and the chunk that it lies in: what one program holds.
struct Placed {
  ChunkKey block;
  Int3 point;  ///< units
  uint32_t vertex = 0;
};

std::pmr::vector<Placed> placedByBlock(std::span<const TexturePoint> positions, const ChunkAt& chunk_at,
                                       std::pmr::memory_resource* memory) {
  std::pmr::vector<Placed> placed(memory);
  placed.reserve(positions.size());
  for (size_t i = 0; i < positions.size(); ++i) {
    Placed& one = placed.emplace_back();
    one.vertex = static_cast<uint32_t>(i);
    for (int axis = 0; axis < 3; ++axis) {
      one.point[axis] = saturate(static_cast<int64_t>(std::floor(positions[i][static_cast<size_t>(axis)] + 0.5)));
    }
    one.block = chunk_at(one.point);
  }
  std::sort(placed.begin(), placed.end(),
            [](const Placed& a, const Placed& b) { return std::tie(a.block, a.vertex) < std::tie(b.block, b.vertex); });
  return placed;
}

/// Where each block's vertices begin, and where the last one's end.
std::pmr::vector<size_t> bordersOf(std::span<const Placed> placed, std::pmr::memory_resource* memory) {
  std::pmr::vector<size_t> borders(memory);
  for (size_t i = 0; i < placed.size(); ++i) {
    if (i == 0 || placed[i].block != placed[i - 1].block) borders.push_back(i);
  }
  borders.push_back(placed.size());
  return borders;
}

}  // namespace

ChunkAt chunksOfLevel(const WorldField& world, int level) {
  return [level, edge = int64_t{kChunkCells} * world.cellAt(level)](Int3 place) {
    ChunkKey key{level, {}};
    for (int axis = 0; axis < 3; ++axis) key.at[axis] = static_cast<int32_t>(floorDiv(place[axis], edge));
    return key;
  };
}

Result<TexturedRegion> unwrapRegion(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh,
                                    const ChunkAt& chunk_at, int32_t tile) {
  std::pmr::memory_resource* memory = world.memory();
  std::pmr::vector<TexturePoint> positions(memory), normals(memory);
  positions.reserve(mesh.positions.size());
  normals.reserve(mesh.positions.size());
  for (const std::array<double, 3>& metres : mesh.positions) {
    positions.push_back({metres[0] * kUnitsPerMetre + mesh.origin.x, metres[1] * kUnitsPerMetre + mesh.origin.y,
                         metres[2] * kUnitsPerMetre + mesh.origin.z});
  }
  for (const VertexAttributes& attributes : mesh.attributes) {
    normals.push_back(unpackNormal(attributes.normal_x, attributes.normal_y));
  }
  const std::pmr::vector<Placed> placed = placedByBlock(positions, chunk_at, memory);
  const std::pmr::vector<size_t> borders = bordersOf(placed, memory);
  const size_t blocks = borders.size() - 1;

  std::pmr::vector<MaterialMix> materials(positions.size(), memory);
  std::pmr::vector<std::optional<Error>> errors(blocks, memory);
  parallelFor(jobs, blocks, [&](size_t b) {
    const std::span<const Placed> own = std::span(placed).subspan(borders[b], borders[b + 1] - borders[b]);
    std::pmr::vector<Int3> points(memory);
    std::pmr::vector<TexturePoint> leaning(memory);
    for (const Placed& one : own) {
      points.push_back(one.point);
      leaning.push_back(normals[one.vertex]);
    }
    std::pmr::vector<MaterialMix> around(own.size(), memory);
    const Result<void> mixed = materialsAround(world, own.front().block.level, nullptr, points, leaning, around);
    if (!mixed) errors[b] = mixed.error();
    for (size_t i = 0; i < own.size(); ++i) materials[own[i].vertex] = around[i];
  });
  for (const std::optional<Error>& error : errors) {
    if (error) return *error;
  }

  // One block after the other: shapes are numbered as they are met.
  SurfaceShapes shapes(world, nullptr, mesh.origin, tile);
  std::pmr::vector<uint32_t> labels(positions.size(), memory), of_block(memory);
  std::pmr::vector<Int3> points(memory);
  for (size_t b = 0; b < blocks; ++b) {
    points.clear();
    for (size_t i = borders[b]; i < borders[b + 1]; ++i) points.push_back(placed[i].point);
    of_block.resize(points.size());
    if (Result<void> labelled = shapes.label(placed[borders[b]].block.level, points, of_block); !labelled)
      return labelled.error();
    for (size_t i = 0; i < points.size(); ++i) labels[placed[borders[b] + i].vertex] = of_block[i];
  }
  const UnwrapInput input{
      positions,    labels,
      mesh.indices, [&shapes](uint32_t label) -> const TextureSpace& { return shapes.space(label); },
      normals,      materials};
  TexturedRegion region{unwrap(input, memory), {}};
  region.density = texelDensity(input, region.unwrapped, tile);
  return region;
}

}  // namespace sgm::api

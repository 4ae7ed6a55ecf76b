#include "region/region_texture.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "chunk/surface_materials.h"
#include "chunk/surface_shapes.h"
#include "mesh/chunk.h"
#include "mesh/vertex.h"

namespace sgm {
namespace {

/// A vertex and the chunk that contains it. All vertices of a chunk are evaluated with one program.
struct Placed {
  ChunkKey block;
  Int3 point;  ///< position of the vertex in whole units
  uint32_t vertex = 0;
};

/// A mesh's vertices, sorted by chunk.
class PlacedMesh {
 public:
  PlacedMesh(const WorldMesh& mesh, const ChunkAt& chunk_at, std::pmr::memory_resource* memory)
      : memory_(memory), positions_(memory), normals_(memory), placed_(memory), borders_(memory) {
    positions_.reserve(mesh.positions.size());
    normals_.reserve(mesh.positions.size());
    for (const std::array<double, 3>& metres : mesh.positions) {
      positions_.push_back({metres[0] * kUnitsPerMetre + mesh.origin.x, metres[1] * kUnitsPerMetre + mesh.origin.y,
                            metres[2] * kUnitsPerMetre + mesh.origin.z});
    }
    for (const VertexAttributes& attributes : mesh.attributes) {
      normals_.push_back(unpackNormal(attributes.normal_x, attributes.normal_y));
    }
    place(chunk_at);
  }

  std::span<const TexturePoint> positions() const { return positions_; }  ///< world positions in units
  std::span<const TexturePoint> normals() const { return normals_; }

  /// Returns the materials at each vertex and around it.
  Result<std::pmr::vector<MaterialMix>> materials(const WorldField& world, JobSystem& jobs) const {
    std::pmr::vector<MaterialMix> materials(positions_.size(), memory_);
    std::pmr::vector<std::optional<Error>> errors(blocks(), memory_);
    parallelFor(jobs, blocks(), [&](size_t b) {
      const std::span<const Placed> own = block(b);
      std::pmr::vector<Int3> points(memory_);
      std::pmr::vector<TexturePoint> leaning(memory_);
      for (const Placed& one : own) {
        points.push_back(one.point);
        leaning.push_back(normals_[one.vertex]);
      }
      std::pmr::vector<MaterialMix> around(own.size(), memory_);
      const Result<void> mixed = materialsAround(world, own.front().block.level, nullptr, points, leaning, around);
      if (!mixed) errors[b] = mixed.error();
      for (size_t i = 0; i < own.size(); ++i) materials[own[i].vertex] = around[i];
    });
    for (const std::optional<Error>& error : errors) {
      if (error) return *error;
    }
    return materials;
  }

  /// Returns, for each vertex, the label of the shape that it lies on. Processes blocks one after another: shapes are
  /// numbered in the order in which they are found, so this order must be fixed.
  Result<std::pmr::vector<uint32_t>> labels(SurfaceShapes& shapes) const {
    std::pmr::vector<uint32_t> labels(positions_.size(), memory_), of_block(memory_);
    std::pmr::vector<Int3> points(memory_);
    for (size_t b = 0; b < blocks(); ++b) {
      const std::span<const Placed> own = block(b);
      points.clear();
      for (const Placed& one : own) points.push_back(one.point);
      of_block.resize(points.size());
      if (Result<void> labelled = shapes.label(own.front().block.level, points, of_block); !labelled)
        return labelled.error();
      for (size_t i = 0; i < own.size(); ++i) labels[own[i].vertex] = of_block[i];
    }
    return labels;
  }

 private:
  size_t blocks() const { return borders_.size() - 1; }
  std::span<const Placed> block(size_t b) const {
    return std::span(placed_).subspan(borders_[b], borders_[b + 1] - borders_[b]);
  }

  void place(const ChunkAt& chunk_at) {
    placed_.reserve(positions_.size());
    for (size_t i = 0; i < positions_.size(); ++i) {
      Placed& one = placed_.emplace_back();
      one.vertex = static_cast<uint32_t>(i);
      for (int axis = 0; axis < 3; ++axis) {
        one.point[axis] = saturate(static_cast<int64_t>(std::floor(positions_[i][static_cast<size_t>(axis)] + 0.5)));
      }
      one.block = chunk_at(one.point);
    }
    std::sort(placed_.begin(), placed_.end(), [](const Placed& a, const Placed& b) {
      return std::tie(a.block, a.vertex) < std::tie(b.block, b.vertex);
    });
    for (size_t i = 0; i < placed_.size(); ++i) {
      if (i == 0 || placed_[i].block != placed_[i - 1].block) borders_.push_back(i);
    }
    borders_.push_back(placed_.size());
  }

  std::pmr::memory_resource* memory_;
  std::pmr::vector<TexturePoint> positions_, normals_;
  std::pmr::vector<Placed> placed_;   ///< the vertices, sorted by block (chunk)
  std::pmr::vector<size_t> borders_;  ///< for each block, the index in placed_ of its first vertex; the last element is
                                      ///< the end of the last block
};

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
  const PlacedMesh placed(mesh, chunk_at, memory);
  const Result<std::pmr::vector<MaterialMix>> materials = placed.materials(world, jobs);
  if (!materials) return materials.error();
  SurfaceShapes shapes(world, nullptr, mesh.origin, tile);
  const Result<std::pmr::vector<uint32_t>> labels = placed.labels(shapes);
  if (!labels) return labels.error();
  const UnwrapInput input{
      placed.positions(), *labels,
      mesh.indices,       [&shapes](uint32_t label) -> const TextureSpace& { return shapes.space(label); },
      placed.normals(),   *materials};
  TexturedRegion region{unwrap(input, memory), {}};
  region.density = texelDensity(input, region.unwrapped, tile);
  return region;
}

Result<Unwrapped> blendRegion(const WorldField& world, JobSystem& jobs, const WorldMesh& mesh,
                              const ChunkAt& chunk_at) {
  const PlacedMesh placed(mesh, chunk_at, world.memory());
  const Result<std::pmr::vector<MaterialMix>> materials = placed.materials(world, jobs);
  if (!materials) return materials.error();
  return pairMaterials(mesh.indices, *materials, world.memory());
}

}  // namespace sgm

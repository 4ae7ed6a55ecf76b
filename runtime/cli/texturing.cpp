#include "cli/texturing.h"

#include <array>
#include <cmath>
#include <map>

#include "mesh/chunk.h"
#include "mesh/vertex.h"
#include "render/image.h"
#include "stream/surface_materials.h"

namespace sgm::cli {
namespace {

constexpr int kChequerPixels = 128;

struct Block {
  std::vector<Int3> points;
  std::vector<TexturePoint> normals;
  std::vector<uint32_t> vertices;
};

/// Vertices by the chunk that they lie in: what one program holds.
std::map<Int3, Block> blocksOf(std::span<const TexturePoint> positions, std::span<const TexturePoint> normals,
                               int64_t edge) {
  std::map<Int3, Block> blocks;
  for (size_t i = 0; i < positions.size(); ++i) {
    Int3 point, block;
    for (int axis = 0; axis < 3; ++axis) {
      point[axis] = saturate(static_cast<int64_t>(std::floor(positions[i][static_cast<size_t>(axis)] + 0.5)));
      block[axis] = static_cast<int32_t>(floorDiv(point[axis], edge));
    }
    Block& into = blocks[block];
    into.points.push_back(point);
    into.normals.push_back(normals[i]);
    into.vertices.push_back(static_cast<uint32_t>(i));
  }
  return blocks;
}

}  // namespace

Result<TexturedRegion> unwrapRegion(const WorldField& world, const WorldMesh& mesh, int level, int32_t tile) {
  std::vector<TexturePoint> positions;
  positions.reserve(mesh.positions.size());
  for (const std::array<double, 3>& metres : mesh.positions) {
    positions.push_back({metres[0] * kUnitsPerMetre + mesh.origin.x, metres[1] * kUnitsPerMetre + mesh.origin.y,
                         metres[2] * kUnitsPerMetre + mesh.origin.z});
  }
  std::vector<TexturePoint> normals;
  for (const VertexAttributes& attributes : mesh.attributes) {
    normals.push_back(unpackNormal(attributes.normal_x, attributes.normal_y));
  }
  SurfaceShapes shapes(world, level, nullptr, mesh.origin, tile);
  std::vector<MaterialMix> materials(positions.size());
  std::vector<uint32_t> labels(positions.size());
  for (const auto& [at, block] : blocksOf(positions, normals, int64_t{kChunkCells} * world.cellAt(level))) {
    std::vector<uint32_t> of_block(block.points.size());
    if (Result<void> labelled = shapes.label(block.points, of_block); !labelled) return labelled.error();
    std::vector<MaterialMix> around(block.points.size());
    Result<void> mixed = materialsAround(world, level, nullptr, block.points, block.normals, around);
    if (!mixed) return mixed.error();
    for (size_t i = 0; i < of_block.size(); ++i) {
      labels[block.vertices[i]] = of_block[i];
      materials[block.vertices[i]] = around[i];
    }
  }
  const UnwrapInput input{
      positions,    labels,
      mesh.indices, [&shapes](uint32_t label) -> const TextureSpace& { return shapes.space(label); },
      normals,      materials};
  TexturedRegion region{unwrap(input, world.memory()), {}};
  region.density = texelDensity(input, region.unwrapped, tile);
  return region;
}

Result<std::vector<std::byte>> chequerPng() {
  using Colour = std::array<uint8_t, 4>;
  constexpr Colour kDark{150, 150, 150, 255}, kLight{225, 225, 225, 255}, kAlongU{200, 60, 50, 255},
      kAlongV{60, 160, 70, 255};
  Image image{kChequerPixels, kChequerPixels, {}};
  const int half = kChequerPixels / 2, line = kChequerPixels / 32;
  for (int y = 0; y < kChequerPixels; ++y) {
    for (int x = 0; x < kChequerPixels; ++x) {
      const Colour& field = (x < half) != (y < half) ? kDark : kLight;
      const Colour& colour = y < line ? kAlongU : x < line ? kAlongV : field;
      image.rgba.insert(image.rgba.end(), colour.begin(), colour.end());
    }
  }
  return encodePng(image);
}

}  // namespace sgm::cli

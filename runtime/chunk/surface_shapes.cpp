#include "chunk/surface_shapes.h"

#include <utility>

#include "backend/cpu/instruction_sets.h"
#include "chunk/surface_materials.h"
#include "mesh/feature_kind.h"
#include "mesh/vertex.h"

namespace sgm {

SurfaceShapes::SurfaceShapes(const WorldField& field, const EditSnapshot* edits, Int3 base, int32_t tile)
    : field_(field), edits_(edits), tile_(tile), spaces_(field.memory()), known_(field.memory()) {
  for (int axis = 0; axis < 3; ++axis) base[axis] = saturate(floorDiv(base[axis], tile) * tile);
  spaces_.emplace_back(base, tile);
}

Result<void> SurfaceShapes::label(int level, std::span<const Int3> points, std::span<uint32_t> labels) {
  IntBox box;
  for (const Int3& p : points) box = box.joined({p, p});
  if (box.empty()) return {};
  const Result<ShapeField> shapes = field_.compileShapes(box, level, edits_);
  if (!shapes) return shapes.error();
  std::pmr::vector<int32_t> x(field_.memory()), y(field_.memory()), z(field_.memory());
  for (const Int3& p : points) {
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
  }
  Attributes attributes;
  attributes.label = labels.data();
  EvalScratch scratch(field_.memory());
  bestKernels().attributes(shapes->program->view(), {x.data(), y.data(), z.data(), points.size()}, scratch, attributes);
  for (uint32_t& label : labels) {
    const std::optional<ShapeLabels::Source> source = shapes->labels.find(label);
    label = 0;
    if (!source) continue;
    const GrammarChunk& chunk = shapes->cells[source->cell]->chunk;
    const auto [known, is_new] =
        known_.try_emplace({level, chunk.layer, chunk.cell, source->shape}, static_cast<uint32_t>(spaces_.size()));
    if (is_new) {
      TextureSpace space(chunk, source->shape, tile_);
      if (space.byWorld()) {
        known->second = 0;
      } else {
        spaces_.push_back(std::move(space));
      }
    }
    label = known->second;
  }
  return {};
}

Result<Unwrapped> unwrapChunk(const WorldField& field, const PackedMesh& mesh, const ChunkGrid& grid,
                              const EditSnapshot* edits, int32_t tile, std::pmr::memory_resource* memory) {
  const size_t count = mesh.vertices.size();
  std::pmr::vector<TexturePoint> positions(memory), normals(memory);
  positions.reserve(count);
  normals.reserve(count);
  for (const Vertex& vertex : mesh.vertices) {
    const auto exact = [&](int32_t origin, int16_t at) { return origin + double{1} * at * grid.cell / kSubcell; };
    positions.push_back(
        {exact(grid.origin.x, vertex.x), exact(grid.origin.y, vertex.y), exact(grid.origin.z, vertex.z)});
    normals.push_back(unpackNormal(vertex.normal_x, vertex.normal_y));
  }
  SurfaceShapes shapes(field, edits, grid.origin, tile);
  std::pmr::vector<uint32_t> labels(count, memory);
  std::pmr::vector<MaterialMix> materials(count, memory);
  for (const bool coarser : {false, true}) {
    std::pmr::vector<uint32_t> asked(memory);
    for (uint32_t v = 0; v < count; ++v) {
      if (isOfCoarserLevel(mesh.vertices[v].kind) == coarser) asked.push_back(v);
    }
    const int level = grid.level + (coarser ? 1 : 0);
    std::pmr::vector<Int3> points(memory);
    std::pmr::vector<TexturePoint> leaning(memory);
    for (const uint32_t v : asked) {
      points.push_back(vertexUnits(grid, mesh.vertices[v]));
      leaning.push_back(normals[v]);
    }
    std::pmr::vector<uint32_t> of_asked(asked.size(), memory);
    std::pmr::vector<MaterialMix> around(asked.size(), memory);
    if (Result<void> labelled = shapes.label(level, points, of_asked); !labelled) return labelled.error();
    Result<void> mixed = materialsAround(field, level, edits, points, leaning, around);
    if (!mixed) return mixed.error();
    for (size_t i = 0; i < asked.size(); ++i) {
      labels[asked[i]] = of_asked[i];
      materials[asked[i]] = around[i];
    }
  }
  const auto space_of = [&shapes](uint32_t label) -> const TextureSpace& { return shapes.space(label); };
  const UnwrapInput input{positions, labels, mesh.indices, space_of, normals, materials, mesh.ranges[0].index_count};
  return unwrap(input, memory);
}

}  // namespace sgm

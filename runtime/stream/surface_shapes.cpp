#include "stream/surface_shapes.h"

#include "backend/cpu/instruction_sets.h"
#include "mesh/vertex.h"
#include "stream/surface_materials.h"

namespace sgm {

SurfaceShapes::SurfaceShapes(const WorldField& field, int level, const EditSnapshot* edits, Int3 base, int32_t tile)
    : field_(field), level_(level), edits_(edits), tile_(tile) {
  for (int axis = 0; axis < 3; ++axis) base[axis] = saturate(floorDiv(base[axis], tile) * tile);
  spaces_.emplace_back(base, tile);
}

Result<void> SurfaceShapes::label(std::span<const Int3> points, std::span<uint32_t> labels) {
  IntBox box;
  for (const Int3& p : points) box = box.joined({p, p});
  if (box.empty()) return {};
  const Result<ShapeField> shapes = field_.compileShapes(box, level_, edits_);
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
    if (chunk.shapes[source->shape].kind == ShapeKind::voxels) continue;  // they lie in the world as its axes do
    const auto [known, is_new] =
        known_.try_emplace({chunk.layer, chunk.cell, source->shape}, static_cast<uint32_t>(spaces_.size()));
    if (is_new) spaces_.emplace_back(chunk, source->shape, tile_);
    label = known->second;
  }
  return {};
}

Result<Unwrapped> unwrapChunk(const WorldField& field, const PackedMesh& mesh, const ChunkGrid& grid,
                              const EditSnapshot* edits, int32_t tile, std::pmr::memory_resource* memory) {
  std::vector<Int3> points;
  std::vector<TexturePoint> positions, normals;
  for (const Vertex& vertex : mesh.vertices) {
    points.push_back(vertexUnits(grid, vertex));
    const auto exact = [&](int32_t origin, uint16_t at) { return origin + double{1} * at * grid.cell / kSubcell; };
    positions.push_back(
        {exact(grid.origin.x, vertex.x), exact(grid.origin.y, vertex.y), exact(grid.origin.z, vertex.z)});
    normals.push_back(unpackNormal(vertex.normal_x, vertex.normal_y));
  }
  std::vector<uint32_t> labels(points.size());
  SurfaceShapes shapes(field, grid.level, edits, grid.origin, tile);
  if (Result<void> labelled = shapes.label(points, labels); !labelled) return labelled.error();
  std::vector<MaterialMix> materials(points.size());
  Result<void> mixed = materialsAround(field, grid.level, edits, points, normals, materials);
  if (!mixed) return mixed.error();
  const auto space_of = [&shapes](uint32_t label) -> const TextureSpace& { return shapes.space(label); };
  return unwrap({positions, labels, mesh.indices, space_of, normals, materials}, memory);
}

}  // namespace sgm

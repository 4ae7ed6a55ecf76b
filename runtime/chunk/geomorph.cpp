#include "chunk/geomorph.h"

#include <algorithm>
#include <cmath>

#include "backend/cpu/instruction_sets.h"
#include "mesh/feature_kind.h"
#include "mesh/vertex.h"
#include "world/chunk_key.h"

namespace sgm {

namespace {

/// Returns a Newton step towards the zero of a field, in 1/256 of a cell. gradient: change of the value in units per
/// unit; cell: cell edge in units.
MorphOffset newtonStep(double value, const std::array<double, 3>& gradient, int32_t cell) {
  const double square = gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2];
  MorphOffset offset{};
  if (!(square > 0) || std::fabs(value) > std::sqrt(square) * kMaxMorph / kSubcell * cell) return offset;
  const double scale = -value / square * kSubcell / cell;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double step = std::floor(scale * gradient[axis] + 0.5);
    offset[axis] = static_cast<int16_t>(std::clamp(step, double{-kMaxMorph}, double{kMaxMorph}));
  }
  return offset;
}

}  // namespace

Result<std::pmr::vector<MorphOffset>> morphOffsets(const WorldField& world, const PackedMesh& mesh,
                                                   const ChunkGrid& grid, const EditSnapshot* edits,
                                                   std::pmr::memory_resource* memory) {
  std::pmr::vector<MorphOffset> offsets(mesh.vertices.size(), memory);
  if (grid.level >= kMaxLevel || mesh.vertices.empty()) return offsets;
  const Result<std::shared_ptr<const FieldProgram>> coarser =
      world.compile(boundsOf(grid, mesh.vertices), grid.level + 1, edits);
  if (!coarser) return coarser.error();

  std::pmr::vector<int32_t> x(memory), y(memory), z(memory);
  std::pmr::vector<size_t> moving(memory);
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    const uint16_t kind = mesh.vertices[i].kind;
    if (kind == kLateralEdge || isOfCoarserLevel(kind)) continue;
    const Int3 p = vertexUnits(grid, mesh.vertices[i]);
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
    moving.push_back(i);
  }
  std::pmr::vector<float> value(moving.size(), memory), gx(moving.size(), memory), gy(moving.size(), memory),
      gz(moving.size(), memory);
  Attributes attributes;
  attributes.value = value.data();
  attributes.gradient_x = gx.data();
  attributes.gradient_y = gy.data();
  attributes.gradient_z = gz.data();
  EvalScratch scratch(memory);
  bestKernels().attributes((*coarser)->view(), {x.data(), y.data(), z.data(), moving.size()}, scratch, attributes);
  for (size_t i = 0; i < moving.size(); ++i) {
    const auto wide = [i](const std::pmr::vector<float>& of) { return static_cast<double>(of[i]); };
    offsets[moving[i]] = newtonStep(wide(value), {wide(gx), wide(gy), wide(gz)}, grid.cell);
  }
  return offsets;
}

}  // namespace sgm

#pragma once
// Edges and corners of a welded mesh, which marching cubes cuts off: feature vertices from the field's gradients (after
// Kobbelt et al. 2001, "Feature Sensitive Surface Extraction from Volume Data").
//
// Each side of a marching-cubes loop lies in a face of its cell. Where the normals at its ends differ, the two tangent
// planes meet in a crease, whose point nearest to the side is a FACE VERTEX; it follows from the side alone, so that
// the cells on both sides of the face, and chunks meshed apart, find the same. A loop with a face vertex becomes a fan
// about a CELL VERTEX, the point nearest to the planes of its own vertices (mesh/least_squares.h). All other triangles
// stay as they are. Where a grid edge passes through a crease the straight line between its ends' values misses the
// surface: its vertex slides along it to where the field changes sign, which depends on that edge alone.

#include <functional>
#include <memory_resource>
#include <span>

#include "mesh/weld.h"

namespace sgm {

/// The field at a point: value in units, gradient, and the gradient as a packed normal.
struct FieldSample {
  float value = 0;
  std::array<float, 3> gradient{};
  int16_t normal_x = 0, normal_y = 0;
};

/// Samples the field at points in units. Called about fifteen times, with many points each.
using FieldSampler = std::function<Result<void>(std::span<const Int3> points, std::span<FieldSample> samples)>;

/// VertexKey::axis of feature vertices: kFaceVertex + the axis that its face stands on, with the face's lowest corner;
/// kCellVertex with the cell's. The fan tells sides of a face, and loops of a cell, apart.
inline constexpr uint8_t kFaceVertex = 4;
inline constexpr uint8_t kCellVertex = 7;

/// Adds feature vertices behind the others. Closed where `mesh` is, and manifold. A feature vertex lies at most
/// 1/25 cell and a unit off the surface, and a cell beyond its face or cell; a cell vertex that finds no such place
/// lies amid its loop. Beside a corner a fan may then fold, by less than 1/50 of a cell's face. Pure: the same bytes
/// for the same mesh and field, with doubles and + - * / sqrt alone. Precondition: bodies of one level, without seams,
/// whose cells have this edge in units. Errors: the sampler's.
Result<WorldMesh> sharpen(const WorldMesh& mesh, int32_t cell, const FieldSampler& field,
                          std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// For drawing: feature vertices once for each side of their crease, with that side's normal. Positions and triangles
/// stay; vertices with equal keys are one in the mesh that this comes from.
WorldMesh splitCreases(const WorldMesh& mesh, std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm

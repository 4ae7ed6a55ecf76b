#include "chunk/surface_materials.h"

#include <algorithm>
#include <cmath>

#include "backend/cpu/instruction_sets.h"
#include "base/fixed.h"

namespace sgm {
namespace {

/// Returns the point itself, followed by places around it on a circle of this radius, in the plane perpendicular to the
/// normal.
std::array<Int3, kMaterialSamples> placesAround(const Int3& point, const TexturePoint& normal, double radius) {
  constexpr double kDiagonal = 0.70710678118654752;
  constexpr std::array<std::array<double, 2>, kMaterialSamples - 1> kRing{{{1, 0},
                                                                           {kDiagonal, kDiagonal},
                                                                           {0, 1},
                                                                           {-kDiagonal, kDiagonal},
                                                                           {-1, 0},
                                                                           {-kDiagonal, -kDiagonal},
                                                                           {0, -1},
                                                                           {kDiagonal, -kDiagonal}}};
  // The axis with the smallest component of the normal is the axis most nearly perpendicular to the normal, so its
  // projection into the plane is long.
  size_t least = 0;
  for (size_t axis = 1; axis < 3; ++axis) {
    if (std::fabs(normal[axis]) < std::fabs(normal[least])) least = axis;
  }
  const size_t second = (least + 1) % 3, third = (least + 2) % 3;
  const double across = std::sqrt(normal[second] * normal[second] + normal[third] * normal[third]);
  TexturePoint u{}, v{};
  u[second] = -normal[third] / across;
  u[third] = normal[second] / across;
  const double length = std::sqrt(across * across + normal[least] * normal[least]);
  v[least] = across / length;
  v[second] = -normal[least] * normal[second] / (across * length);
  v[third] = -normal[least] * normal[third] / (across * length);
  std::array<Int3, kMaterialSamples> places;
  places[0] = point;
  for (size_t i = 0; i < kRing.size(); ++i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double offset = radius * (kRing[i][0] * u[axis] + kRing[i][1] * v[axis]);
      const int a = static_cast<int>(axis);
      places[i + 1][a] = saturate(point[a] + static_cast<int64_t>(std::floor(offset + 0.5)));
    }
  }
  return places;
}

/// Coordinates of points, in one array per axis, as the evaluators read them.
class PointList {
 public:
  explicit PointList(std::pmr::memory_resource* memory) : x_(memory), y_(memory), z_(memory) {}
  void add(const Int3& p) {
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
  }
  size_t size() const { return x_.size(); }
  Int3 at(size_t i) const { return {x_[i], y_[i], z_[i]}; }
  Points view() const { return {x_.data(), y_.data(), z_.data(), x_.size()}; }

 private:
  std::pmr::vector<int32_t> x_, y_, z_;
};

/// The labels and values that the evaluator has computed at the points.
struct Made {
  std::pmr::vector<uint32_t> labels;
  std::pmr::vector<float> values;  ///< field values in units, negative in the solid

  Made(const ProgramView& program, const PointList& points, EvalScratch& scratch, std::pmr::memory_resource* memory)
      : labels(points.size(), memory), values(points.size(), memory) {
    Attributes attributes;
    attributes.label = labels.data();
    attributes.value = values.data();
    bestKernels().attributes(program, points.view(), scratch, attributes);
  }
  bool isSolid(size_t i) const { return values[i] < 0; }
  uint16_t material(size_t i) const { return static_cast<uint16_t>(labels[i] & 0xFFFFu); }
};

/// If a place is in the air, the solid behind it is searched at kPlacesBehind points, in this order: half a cell and
/// one cell against the vertex's normal, then the corners of the vertex's cell, at least one of which is solid.
constexpr size_t kStepsBehind = 2, kPlacesBehind = kStepsBehind + 8;

std::array<Int3, kPlacesBehind> placesBehind(const Int3& place, const Int3& vertex, const TexturePoint& normal,
                                             int64_t cell) {
  std::array<Int3, kPlacesBehind> places;
  const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  for (size_t i = 0; i < kStepsBehind; ++i) {
    const double way = static_cast<double>(cell) * static_cast<double>(i + 1) / kStepsBehind;
    for (int a = 0; a < 3; ++a) {
      places[i][a] =
          saturate(place[a] - static_cast<int64_t>(std::floor(way * normal[static_cast<size_t>(a)] / length + 0.5)));
    }
  }
  for (size_t i = 0; i < 8; ++i) {
    for (int a = 0; a < 3; ++a) {
      const int64_t low = floorDiv(vertex[a], cell) * cell;
      places[kStepsBehind + i][a] = saturate((i >> a & 1) != 0 && low != vertex[a] ? low + cell : low);
    }
  }
  return places;
}

/// Returns the material of the solid behind a place: at the first step that is in the solid, or else at the deepest
/// corner. first: index of the place's first step in `made`.
uint16_t materialBehind(const Made& made, size_t first) {
  for (size_t i = first; i < first + kStepsBehind; ++i) {
    if (made.isSolid(i)) return made.material(i);
  }
  const auto corners = made.values.begin() + static_cast<std::ptrdiff_t>(first + kStepsBehind);
  return made.material(static_cast<size_t>(std::min_element(corners, corners + 8) - made.values.begin()));
}

}  // namespace

Result<void> materialsAround(const WorldField& field, int level, const EditSnapshot* edits,
                             std::span<const Int3> points, std::span<const TexturePoint> normals,
                             std::span<MaterialMix> materials) {
  const int32_t cell = field.cellAt(level);
  PointList places(field.memory());
  IntBox box;
  for (size_t i = 0; i < points.size(); ++i) {
    for (const Int3& p : placesAround(points[i], normals[i], cell)) {
      places.add(p);
      box = box.joined({p, p});
    }
  }
  if (box.empty()) return {};
  const auto program = field.compile(box.grown(cell), level, edits);
  if (!program) return program.error();
  EvalScratch scratch(field.memory());
  const Made around((*program)->view(), places, scratch, field.memory());

  // The surface of the mesh only approximates the surface of the field. So a place can lie in the air, where no shape
  // defines a material; it then gets the material of the solid behind it. The search for this solid is skipped if the
  // grammar has only the default material.
  const bool named = field.settings().program->materials.size() > 1;
  PointList behind(field.memory());
  std::pmr::vector<size_t> in_air(field.memory());
  for (size_t i = 0; i < places.size(); ++i) {
    const size_t vertex = i / kMaterialSamples;
    materials[vertex][i % kMaterialSamples] = around.material(i);
    if (!named || around.material(i) != 0 || around.isSolid(i)) continue;
    in_air.push_back(i);
    for (const Int3& p : placesBehind(places.at(i), points[vertex], normals[vertex], cell)) behind.add(p);
  }
  if (in_air.empty()) return {};
  const Made made((*program)->view(), behind, scratch, field.memory());
  for (size_t i = 0; i < in_air.size(); ++i) {
    materials[in_air[i] / kMaterialSamples][in_air[i] % kMaterialSamples] = materialBehind(made, i * kPlacesBehind);
  }
  return {};
}

}  // namespace sgm

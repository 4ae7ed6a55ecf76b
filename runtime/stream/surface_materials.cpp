#include "stream/surface_materials.h"

#include <cmath>

#include "backend/cpu/instruction_sets.h"

namespace sgm {
namespace {

/// Places around a point, the point first.
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
  // The axis that the normal leans on least is far from it, so that its shadow on the plane is long.
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

}  // namespace

Result<void> materialsAround(const WorldField& field, int level, const EditSnapshot* edits,
                             std::span<const Int3> points, std::span<const TexturePoint> normals,
                             std::span<MaterialMix> materials) {
  std::pmr::vector<int32_t> x(field.memory()), y(field.memory()), z(field.memory());
  IntBox box;
  for (size_t i = 0; i < points.size(); ++i) {
    for (const Int3& p : placesAround(points[i], normals[i], field.cellAt(level))) {
      x.push_back(p.x);
      y.push_back(p.y);
      z.push_back(p.z);
      box = box.joined({p, p});
    }
  }
  if (box.empty()) return {};
  const auto program = field.compile(box, level, edits);
  if (!program) return program.error();
  std::pmr::vector<uint32_t> labels(x.size(), field.memory());
  Attributes attributes;
  attributes.label = labels.data();
  EvalScratch scratch(field.memory());
  bestKernels().attributes((*program)->view(), {x.data(), y.data(), z.data(), x.size()}, scratch, attributes);
  for (size_t i = 0; i < labels.size(); ++i) {
    materials[i / kMaterialSamples][i % kMaterialSamples] = static_cast<uint16_t>(labels[i] & 0xFFFFu);
  }
  return {};
}

}  // namespace sgm

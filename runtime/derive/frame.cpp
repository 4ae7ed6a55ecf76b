#include "derive/frame.h"

#include <cmath>

#include "base/math.h"

namespace sgm {
namespace {

/// Sets tiny values to 0: sines and cosines of quarter turns are inexact because pi is rounded, but axes must stay
/// exact.
double cleaned(double v) { return std::fabs(v) < 1e-15 ? 0.0 : v; }

}  // namespace

double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

double length(Vec3 a) { return std::sqrt(dot(a, a)); }

Vec3 normalised(Vec3 v) {
  const double size = length(v);
  return size > 0 ? (1.0 / size) * v : Vec3{};
}

Vec3 across(Vec3 tangent, Vec3 wanted) {
  const Vec3 flat = wanted - dot(wanted, tangent) * tangent;
  if (length(flat) > 1e-3) return normalised(flat);
  const Vec3 other = std::fabs(tangent.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  return normalised(other - dot(other, tangent) * tangent);
}

int32_t toUnits(double metres) {
  if (std::isnan(metres)) return 0;
  const double units = detFloor(metres * kUnitsPerMetre + 0.5);
  if (units <= -2147483648.0) return std::numeric_limits<int32_t>::min();
  if (units >= 2147483647.0) return std::numeric_limits<int32_t>::max();
  return static_cast<int32_t>(units);
}

Vec3 Placement::direction(Vec3 v) const {
  return {axes[0] * v.x + axes[1] * v.y + axes[2] * v.z, axes[3] * v.x + axes[4] * v.y + axes[5] * v.z,
          axes[6] * v.x + axes[7] * v.y + axes[8] * v.z};
}

Vec3 Placement::toCell(Vec3 local) const { return offset + scale * direction(local); }

Vec3 Placement::fromCell(Vec3 cell) const {
  const Vec3 d = cell - offset;
  return {(axes[0] * d.x + axes[3] * d.y + axes[6] * d.z) / scale,
          (axes[1] * d.x + axes[4] * d.y + axes[7] * d.z) / scale,
          (axes[2] * d.x + axes[5] * d.y + axes[8] * d.z) / scale};
}

Int3 Placement::snap(Vec3 local) const {
  const Vec3 cell = toCell(local);
  return saturatingAdd(base, {toUnits(cell.x), toUnits(cell.y), toUnits(cell.z)});
}

Placement Placement::moved(Vec3 local) const {
  Placement result = *this;
  result.offset = toCell(local);
  return result;
}

Placement Placement::turned(Vec3 axis, double angle) const {
  const double size = length(axis);
  if (!(size > 0)) return *this;
  const Vec3 n = (1.0 / size) * axis;
  const double s = cleaned(detSin(angle)), c = cleaned(detCos(angle)), k = 1.0 - c;
  const std::array<double, 9> r{c + k * n.x * n.x,       k * n.x * n.y - s * n.z, k * n.x * n.z + s * n.y,
                                k * n.y * n.x + s * n.z, c + k * n.y * n.y,       k * n.y * n.z - s * n.x,
                                k * n.z * n.x - s * n.y, k * n.z * n.y + s * n.x, c + k * n.z * n.z};
  Placement result = *this;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      result.axes[3 * i + j] = axes[3 * i] * r[j] + axes[3 * i + 1] * r[3 + j] + axes[3 * i + 2] * r[6 + j];
    }
  }
  return result;
}

Placement Placement::scaled(double factor) const {
  Placement result = *this;
  result.scale = scale * factor;
  return result;
}

Placement Placement::mirrored(int axis) const {
  Placement result = *this;
  const size_t column = static_cast<size_t>(axis);
  for (size_t row = 0; row < 3; ++row) result.axes[3 * row + column] = -result.axes[3 * row + column];
  return result;
}

Frame Placement::frame(Vec3 local) const {
  Frame result;
  result.origin = snap(local);
  for (size_t i = 0; i < 3; ++i) {
    // Adding 0 turns -0 into 0, so that equal frames have equal bits.
    for (size_t j = 0; j < 3; ++j) result.rows[3 * i + j] = static_cast<float>(axes[3 * j + i] + 0.0);
  }
  return result;
}

}  // namespace sgm

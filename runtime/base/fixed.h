#pragma once
// World positions: int32 coordinates in units of 1/1024 m, so the world reaches to about +-2,097 km on each axis
// (arithmetic contract, runtime/README.md).

#include <algorithm>
#include <compare>
#include <cstdint>
#include <limits>

namespace sgm {

inline constexpr int32_t kUnitsPerMetre = 1024;
inline constexpr double metres(int32_t units) { return static_cast<double>(units) / kUnitsPerMetre; }

/// A world position or an offset, in units of 1/1024 m.
struct Int3 {
  int32_t x = 0, y = 0, z = 0;
  friend auto operator<=>(const Int3&, const Int3&) = default;
  constexpr int32_t& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr int32_t operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

inline int32_t saturate(int64_t v) {
  return static_cast<int32_t>(
      std::clamp<int64_t>(v, std::numeric_limits<int32_t>::min(), std::numeric_limits<int32_t>::max()));
}

/// floor(a / b). Precondition: b > 0.
inline constexpr int64_t floorDiv(int64_t a, int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

inline Int3 saturatingAdd(Int3 a, Int3 b) {
  return {saturate(int64_t{a.x} + b.x), saturate(int64_t{a.y} + b.y), saturate(int64_t{a.z} + b.z)};
}
inline Int3 saturatingSub(Int3 a, Int3 b) {
  return {saturate(int64_t{a.x} - b.x), saturate(int64_t{a.y} - b.y), saturate(int64_t{a.z} - b.z)};
}

/// An axis-aligned box of world positions, closed: lo and hi belong to the box. It is empty if lo > hi on any axis.
struct IntBox {
  Int3 lo{1, 1, 1};
  Int3 hi{0, 0, 0};

  static IntBox everything() {
    constexpr int32_t a = std::numeric_limits<int32_t>::min(), b = std::numeric_limits<int32_t>::max();
    return {{a, a, a}, {b, b, b}};
  }
  constexpr bool empty() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }
  constexpr bool contains(Int3 p) const {
    return p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y && p.z >= lo.z && p.z <= hi.z;
  }
  constexpr bool contains(const IntBox& b) const { return b.empty() || (contains(b.lo) && contains(b.hi)); }
  constexpr bool meets(const IntBox& b) const {
    return !empty() && !b.empty() && lo.x <= b.hi.x && b.lo.x <= hi.x && lo.y <= b.hi.y && b.lo.y <= hi.y &&
           lo.z <= b.hi.z && b.lo.z <= hi.z;
  }
  /// Returns the box enlarged by `margin` units on every side, clamped to the int32 range of the world.
  IntBox grown(int32_t margin) const {
    if (empty()) return *this;
    return {saturatingSub(lo, {margin, margin, margin}), saturatingAdd(hi, {margin, margin, margin})};
  }
  /// Returns the smallest box that contains this box and b.
  IntBox joined(const IntBox& b) const {
    if (empty()) return b;
    if (b.empty()) return *this;
    return {{std::min(lo.x, b.lo.x), std::min(lo.y, b.lo.y), std::min(lo.z, b.lo.z)},
            {std::max(hi.x, b.hi.x), std::max(hi.y, b.hi.y), std::max(hi.z, b.hi.z)}};
  }
  IntBox clipped(const IntBox& b) const {
    return {{std::max(lo.x, b.lo.x), std::max(lo.y, b.lo.y), std::max(lo.z, b.lo.z)},
            {std::min(hi.x, b.hi.x), std::min(hi.y, b.hi.y), std::min(hi.z, b.hi.z)}};
  }
  friend bool operator==(const IntBox&, const IntBox&) = default;
};

}  // namespace sgm

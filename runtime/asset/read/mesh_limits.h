#pragma once
// What a file from outside may ask for, and how it is refused: what is wrong, and where in the file.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include "base/result.h"

namespace sgm::asset {

/// Beside these a reader takes no more memory than a small multiple of the file's size.
struct MeshLimits {
  size_t points = 1u << 22;  ///< of a GLB file: of all primitives, each as often as nodes show it
  size_t triangles = 1u << 22;
  double farthest = 1e6;         ///< metres from the origin, along each axis
  size_t json_bytes = 1u << 20;  ///< of a GLB file
  size_t nodes = 1u << 16;       ///< of a GLB file

  /// Points are numbered in 32 bits, and the last number means none.
  size_t mostPoints() const { return std::min<size_t>(points, 0xFFFFFFFEu); }
  bool isPlace(double x, double y, double z) const {
    return std::fabs(x) <= farthest && std::fabs(y) <= farthest && std::fabs(z) <= farthest;
  }
};

inline std::string noPlaceWithin(const MeshLimits& limits) {
  const std::string farthest = std::to_string(static_cast<long long>(limits.farthest));
  return "that is no number from -" + farthest + " to " + farthest;
}

/// Whether a number from a file is one that attributes hold.
inline bool isFloat(double value) { return std::fabs(value) <= double{std::numeric_limits<float>::max()}; }

inline Error wrongAtByte(std::string_view what, size_t byte) {
  return {Code::bad_input, std::string(what) + ", at byte " + std::to_string(byte), 0, 0};
}
inline Error wrongAtLine(std::string_view what, size_t line) {
  return {Code::bad_input, std::string(what) + ", at line " + std::to_string(line), static_cast<int>(line), 0};
}
/// pointer: a JSON pointer (RFC 6901).
inline Error wrongInJson(std::string_view what, std::string_view pointer) {
  return {Code::bad_input, std::string(what) + ", at " + std::string(pointer) + " of its JSON", 0, 0};
}
/// The pointer in a message of wrongInJson(), whatever stands around it; empty where there is none.
inline std::string_view pointerIn(std::string_view message) {
  const size_t end = message.find(" of its JSON");
  const size_t begin = message.substr(0, end).rfind(", at /");
  return begin == message.npos || end == message.npos ? std::string_view() : message.substr(begin + 5, end - begin - 5);
}
/// "it has more than 4 points"
inline Error overLimit(size_t most, std::string_view of_what) {
  return {Code::limit, "it has more than " + std::to_string(most) + " " + std::string(of_what), 0, 0};
}

}  // namespace sgm::asset

#pragma once
// Limits on the content of mesh files, and errors that state a problem and its place in the file.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include "base/result.h"

namespace sgm::asset {

/// Limits for readers of mesh files. Apart from the mesh itself, a reader's memory is at most a small multiple of the
/// file's size.
struct MeshLimits {
  size_t points = 1u << 22;  ///< maximum number of points; in a GLB file, the points of a primitive count once for each
                             ///< node that uses it
  size_t triangles = 1u << 22;
  double farthest = 1e6;         ///< maximum absolute coordinate along each axis, in metres
  size_t json_bytes = 1u << 20;  ///< maximum size of the JSON in a GLB file, in bytes
  size_t nodes = 1u << 16;       ///< maximum number of nodes in a GLB file

  /// Returns `points`, at most what 32-bit indices allow; the largest index is reserved for "none".
  size_t maxPoints() const { return std::min<size_t>(points, 0xFFFFFFFEu); }
  bool isPlace(double x, double y, double z) const {
    return std::fabs(x) <= farthest && std::fabs(y) <= farthest && std::fabs(z) <= farthest;
  }
};

inline std::string noPlaceWithin(const MeshLimits& limits) {
  const std::string farthest = std::to_string(static_cast<long long>(limits.farthest));
  return "that is not a number from -" + farthest + " to " + farthest;
}

/// True if the number is in the range of float, the type of attributes.
inline bool isFloat(double value) { return std::fabs(value) <= double{std::numeric_limits<float>::max()}; }

inline Error wrongAtByte(std::string_view what, size_t byte) {
  return {Code::bad_input, std::string(what) + ", at byte " + std::to_string(byte), 0, 0};
}
inline Error wrongAtLine(std::string_view what, size_t line) {
  return {Code::bad_input, std::string(what) + ", at line " + std::to_string(line), static_cast<int>(line), 0};
}
/// Makes an error with a place in JSON. pointer: the place as a JSON pointer (RFC 6901).
inline Error wrongInJson(std::string_view what, std::string_view pointer) {
  return {Code::bad_input, std::string(what) + ", at " + std::string(pointer) + " of its JSON", 0, 0};
}
/// Extracts the JSON pointer from a message that contains the message of wrongInJson(); empty if there is none.
inline std::string_view pointerIn(std::string_view message) {
  const size_t end = message.find(" of its JSON");
  const size_t begin = message.substr(0, end).rfind(", at /");
  return begin == message.npos || end == message.npos ? std::string_view() : message.substr(begin + 5, end - begin - 5);
}
/// Makes an error such as "it has more than 4 points".
inline Error overLimit(size_t most, std::string_view of_what) {
  return {Code::limit, "it has more than " + std::to_string(most) + " " + std::string(of_what), 0, 0};
}

}  // namespace sgm::asset

#include "asset/read/glb_transform.h"

#include <cmath>
#include <string>

namespace sgm::asset {

GlbTransform glbTransformOf(Point translation, const std::array<double, 4>& q, Point scale) {
  const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const double x = q[0] / size, y = q[1] / size, z = q[2] / size, w = q[3] / size;
  GlbTransform out;
  out.columns[0] = scale.x * Point{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
  out.columns[1] = scale.y * Point{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
  out.columns[2] = scale.z * Point{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
  out.origin = translation;
  return out;
}

std::optional<GlbTransform> glbTransformOf(const std::array<double, 16>& m) {
  constexpr double kSlight = 1e-5;
  if (std::fabs(m[3]) > kSlight || std::fabs(m[7]) > kSlight || std::fabs(m[11]) > kSlight ||
      std::fabs(m[15] - 1) > kSlight)
    return std::nullopt;
  return GlbTransform{{Point{m[0], m[1], m[2]}, Point{m[4], m[5], m[6]}, Point{m[8], m[9], m[10]}},
                      {m[12], m[13], m[14]}};
}

Result<GlbTransform> glbTransformOf(const JsonValue& node, size_t number) {
  const auto refused = [&](std::string_view what) {
    const std::string text = std::to_string(number);
    return wrongInJson("node " + text + std::string(what), "/nodes/" + text);
  };
  std::array<double, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::array<double, 3> moved{}, scaled{1, 1, 1};
  std::array<double, 4> q{0, 0, 0, 1};
  if (!readNumbers(node, "matrix", m) || !readNumbers(node, "translation", moved) ||
      !readNumbers(node, "scale", scaled) || !readNumbers(node, "rotation", q))
    return refused(" has a transform with values that are not numbers, or a wrong count of them");
  if (node.find("matrix") != nullptr) {
    const std::optional<GlbTransform> out = glbTransformOf(m);
    if (!out) return refused(" is moved by a matrix whose last row is not 0, 0, 0, 1");
    return *out;
  }
  if (!(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > 0))
    return refused(" is turned by a quaternion without a length");
  return glbTransformOf({moved[0], moved[1], moved[2]}, q, {scaled[0], scaled[1], scaled[2]});
}

}  // namespace sgm::asset

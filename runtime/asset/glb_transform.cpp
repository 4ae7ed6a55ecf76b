#include "asset/glb_transform.h"

#include <cmath>
#include <string>

namespace sgm::asset {

namespace {

/// As many numbers as there are in `out`; false where the member is something else. A missing one leaves them be.
template <size_t N>
bool readNumbers(const JsonValue& node, std::string_view name, std::array<double, N>& out) {
  if (node.find(name) == nullptr) return true;
  const auto list = node.list(name);
  if (list.size() != N) return false;
  for (size_t i = 0; i < N; ++i) {
    if (list[i].kind != JsonValue::Kind::number || !(std::fabs(list[i].number) <= 1e9)) return false;
    out[i] = list[i].number;
  }
  return true;
}

}  // namespace

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
    return refused(" is moved by what are not numbers, or not as many as it takes");
  GlbTransform out;
  if (node.find("matrix") != nullptr) {
    out.columns = {Point{m[0], m[1], m[2]}, Point{m[4], m[5], m[6]}, Point{m[8], m[9], m[10]}};
    out.origin = {m[12], m[13], m[14]};
    return out;
  }
  const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(size > 0)) return refused(" is turned by a quaternion without a length");
  const double x = q[0] / size, y = q[1] / size, z = q[2] / size, w = q[3] / size;
  out.columns[0] = scaled[0] * Point{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
  out.columns[1] = scaled[1] * Point{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
  out.columns[2] = scaled[2] * Point{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
  out.origin = {moved[0], moved[1], moved[2]};
  return out;
}

}  // namespace sgm::asset

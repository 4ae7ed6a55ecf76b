#include "asset/read/mesh_origin.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/fixed.h"

namespace sgm::asset {
namespace {

constexpr size_t kFarthestIn = size_t{1} << 20;
/// Texts that precede the origin's numbers: in text formats and the STL header, and in the extras of glTF.
constexpr std::string_view kTextKey = "origin_units ", kJsonKey = "\"sgm\":{\"originUnits\":[";

std::optional<Point> unitsAt(std::string_view text, char between) {
  Point units;
  for (int axis = 0; axis < 3; ++axis) {
    int32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<size_t>(end - text.data()));
    units[axis] = value;
    if (axis == 2) break;
    if (text.empty() || text.front() != between) return std::nullopt;
    text.remove_prefix(1);
  }
  return units;
}

}  // namespace

Point originOf(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), kFarthestIn));
  const bool json = text.starts_with("glTF");
  const std::string_view key = json ? kJsonKey : kTextKey;
  const size_t at = text.find(key);
  if (at == std::string_view::npos) return {};
  const std::optional<Point> units = unitsAt(text.substr(at + key.size()), json ? ',' : ' ');
  return units ? (1.0 / kUnitsPerMetre) * *units : Point{};
}

}  // namespace sgm::asset

#include "tools/preview/pointed_place.h"

#include <cmath>

#include "query/explain.h"
#include "query/queries.h"

namespace sgm::preview {
namespace {

std::string sourceOf(const Program& program, const std::string& file, const Span& span) {
  const bool imported = span.file != 0 && span.file < program.modules.size();
  const std::string name = imported ? std::string(program.modules[span.file].path) : file;
  return name + ":" + std::to_string(span.line) + ":" + std::to_string(span.column);
}

}  // namespace

Result<std::optional<PointedPlace>> placeOnRay(const WorldField& world, const std::string& file,
                                               const std::array<double, 3>& from, const glm::dvec3& direction) {
  std::array<double, 3> start{};
  for (size_t axis = 0; axis < 3; ++axis) start[axis] = from[axis] * kUnitsPerMetre;
  const auto longest = static_cast<double>(longestRay(world.cellAt(0)));
  const Result<std::optional<SurfacePoint>> hit =
      rayCast(queryField(world), start, {direction.x, direction.y, direction.z}, longest);
  if (!hit) return hit.error();
  if (!*hit) return std::optional<PointedPlace>();

  const SurfacePoint& point = **hit;
  Int3 units;
  for (int axis = 0; axis < 3; ++axis)
    units[axis] = saturate(static_cast<int64_t>(std::llround(point.position[static_cast<size_t>(axis)])));
  const Result<Explanation> found = explain(world, units);
  if (!found) return found.error();

  const Program& program = *world.settings().program;
  PointedPlace place;
  for (size_t axis = 0; axis < 3; ++axis) place.position[axis] = point.position[axis] / kUnitsPerMetre;
  place.material = program.materials[point.material];
  place.tag = program.tags[point.tag];
  if (!found->nodes.empty()) {
    const ExplainedNode& leaf = found->nodes[found->leaf];
    place.path = leaf.path;
    place.source = sourceOf(program, file, leaf.span);
  }
  return std::optional(std::move(place));
}

}  // namespace sgm::preview

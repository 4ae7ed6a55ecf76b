#pragma once
// Finds the point of the world under the mouse pointer, and the grammar rules that made the surface there.

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "base/result.h"
#include "world/world_field.h"

namespace sgm::preview {

struct PointedPlace {
  std::array<double, 3> position{};  ///< metres of the world
  std::string path;                  ///< path of the rule use that made the surface; empty: the grammar's domain itself
  std::string source;                ///< "file:line:column" of the statement that made the surface; empty if `path` is
  std::string material, tag;         ///< empty: none
};

/// Finds the first surface on a ray. from: metres of the world; direction: must not be 0. Returns nullopt if there is
/// no surface within the maximal length. file: name of the grammar in messages. Errors: those of rayCast and of
/// explain.
Result<std::optional<PointedPlace>> placeOnRay(const WorldField& world, const std::string& file,
                                               const std::array<double, 3>& from, const glm::dvec3& direction);

}  // namespace sgm::preview

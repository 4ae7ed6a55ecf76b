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
  std::array<double, 3> position{};  ///< point of the surface in the world, metres
  /// Derivation path of the rule use that made the surface; empty: the domain of the grammar made it.
  std::string path;
  std::string source;         ///< "file:line:column" of the statement that made the surface; empty if `path` is empty
  std::string material, tag;  ///< empty: none
};

/// Finds the first surface on a ray. from: start of the ray in the world, metres. direction: must not be 0. file: name
/// of the grammar for messages. Returns nullopt if there is no surface within the maximum ray length. Errors: those of
/// rayCast and of explain.
Result<std::optional<PointedPlace>> placeOnRay(const WorldField& world, const std::string& file,
                                               const std::array<double, 3>& from, const glm::dvec3& direction);

}  // namespace sgm::preview

#pragma once
// Finds the place of a world under a pointer, and the rules that made it.

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "base/result.h"
#include "world/world_field.h"

namespace sgm::preview {

struct PointedPlace {
  std::array<double, 3> position{};  ///< metres of the world
  std::string path;                  ///< of the use of a rule that made it; empty: the domain itself
  std::string source;                ///< "file:line:column" of its statement; empty if path is
  std::string material, tag;         ///< empty: none
};

/// The first surface on a ray from a place in metres, up to the maximal length; nullopt if there is none. direction
/// must not be 0. file: the grammar's name in messages. Errors: those of rayCast and of explain.
Result<std::optional<PointedPlace>> placeOnRay(const WorldField& world, const std::string& file,
                                               const std::array<double, 3>& from, const glm::dvec3& direction);

}  // namespace sgm::preview

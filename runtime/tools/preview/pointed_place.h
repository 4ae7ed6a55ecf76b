#pragma once
// The place of a world that a pointer shows, and the rules that have made it.

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "base/result.h"
#include "world/world_field.h"

namespace sgm::preview {

struct PointedPlace {
  std::array<double, 3> position{};  ///< metres of the world
  std::string path;                  ///< of the use of a rule that made it; empty: the domain's own
  std::string source;                ///< "file:line:column" of its statement; empty with the path
  std::string material, tag;         ///< empty: none
};

/// The first surface on a ray from a place in metres, as far as rays go; nullopt where there is none. direction is not
/// 0. file: how messages name the grammar itself. Errors: those of rayCast and of explain.
Result<std::optional<PointedPlace>> placeOnRay(const WorldField& world, const std::string& file,
                                               const std::array<double, 3>& from, const glm::dvec3& direction);

}  // namespace sgm::preview

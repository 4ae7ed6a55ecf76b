#pragma once
// Queries of the field itself, without a mesh: ray casts, the nearest surface, walkable floors. Callable from any
// thread; the same answer on every machine and at any distance from the origin.
//
// Positions, lengths and distances are in units, with fractions. Common errors: invalid_argument (not finite, or
// outside of the stated range), range (a position outside of the world), limit (too far or too large; the message names
// the limit), and those of compiling the field.

#include <array>
#include <functional>
#include <memory>
#include <memory_resource>
#include <optional>

#include "base/result.h"
#include "field/program.h"

namespace sgm {

/// The field to query: a world's, edited or not, at level 0.
struct QueryField {
  /// Compiles everything that matters in a closed box.
  std::function<Result<std::shared_ptr<const FieldProgram>>(const IntBox&)> at;
  int32_t finest_cell = kUnitsPerMetre / 2;  ///< edge of a level-0 cell
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
  bool sampled = false;  ///< a program's cost grows with its box (sampled host fields): ask for small boxes
};

class WorldField;
/// A world's own field, which must outlive it.
QueryField queryField(const WorldField& world);

/// A place on the surface.
struct SurfacePoint {
  std::array<double, 3> position{};
  std::array<double, 3> normal{};  ///< unit vector pointing out of the solid, as in vertices
  double distance = 0;             ///< from the queried place
  uint16_t material = 0, tag = 0;
  bool inside = false;  ///< the queried place itself is solid
};

/// The largest length of a ray, and the largest search distance of closestPoint().
int64_t longestRay(int32_t finest_cell);
int64_t farthestSurface(int32_t finest_cell);

/// Finds the first solid along the ray within `length`. A ray that starts in the solid hits it at once (inside). The
/// ray misses no solid that it crosses for a sixteenth of a cell or one unit, whichever is more; so it misses no wall
/// as thick as a cell, which a mesh of level 0 always shows. The hit lies on the void's side, less than a unit from the
/// solid. A ray ends at the end of the world. direction: any length but 0. length: 0 to longestRay().
///
/// Interval bounds over whole stretches of the ray limit the steps: empty space costs almost nothing, and the result
/// does not depend on the steepness of the field. Only stretches that are not proven empty are sampled.
Result<std::optional<SurfacePoint>> rayCast(const QueryField& field, const std::array<double, 3>& from,
                                            const std::array<double, 3>& direction, double length);

/// Finds the surface nearest to a place within `max_distance` (0 to farthestSurface()); nullopt if there is none.
/// Considers all of the surface that the samples of level 0 show: none of it is nearer than the answer by more than a
/// quarter of a cell and a sixty-fourth of the distance; usually the answer is exact to a unit. On the position's side
/// towards the place lies the void, or, if the place is inside the solid, the solid.
Result<std::optional<SurfacePoint>> closestPoint(const QueryField& field, const std::array<double, 3>& place,
                                                 double max_distance);

/// The agent of isWalkable(): an upright cylinder.
struct Walker {
  double radius = 0.3 * kUnitsPerMetre;  ///< 0 to 64 cells
  double height = 1.8 * kUnitsPerMetre;  ///< above 0, to 256 cells
  double step = 0.4 * kUnitsPerMetre;    ///< climbs and drops this much from one place to the next; below `height`
  double slope = 0.7071067811865476;     ///< least y of a floor's normal: the cosine of the steepest angle; 0 to 1
  double area = 1024.0 * 1024.0;         ///< square units of connected floor that make a box walkable; 0 or more
};

struct WalkableArea {
  bool walkable = false;  ///< `largest` is not 0, and is at least the walker's `area`
  double standing = 0;    ///< the floor in the box on which the walker can stand, square units seen from above
  double largest = 0;     ///< the largest connected part of that
  uint8_t sides = 0;      ///< side faces of the box that the largest part reaches, bit (1 << Face)
};

/// Finds where a walker can stand in a box (closed, not empty) and how far it can walk, on the samples of level 0, one
/// cell apart. A place to stand is a column of samples with a floor in the box: solid under void, a normal within the
/// slope, the walker's height free above it, and no solid within the walker's radius that is higher than its step and
/// lower than its head. Adjacent places are connected if their floors differ by no more than the step. A passage is
/// walkable if `sides` has both its ends.
/// limit: more than 4,096 chunks of 32^3 cells.
Result<WalkableArea> isWalkable(const QueryField& field, const IntBox& box, const Walker& walker);

}  // namespace sgm

#pragma once
// Queries of the field itself, without a mesh: ray casts, the nearest surface, walkable floors. Can be called from any
// thread. The results are the same on every machine, and equally precise at any distance from the origin. Positions,
// lengths and distances are in units, and may have fractions. Errors of all functions: invalid_argument (an argument is
// not finite, or outside of the stated range), range (a position is outside of the world), limit (an argument is too
// far or too large; the message names the limit), and the errors of compiling the field.

#include <array>
#include <functional>
#include <memory>
#include <memory_resource>
#include <optional>

#include "base/result.h"
#include "field/program.h"

namespace sgm {

/// The field to be queried: that of a world, with or without edits, at level 0.
struct QueryField {
  /// Returns a program of the field that is valid in the closed box.
  std::function<Result<std::shared_ptr<const FieldProgram>>(const IntBox&)> at;
  int32_t finest_cell = kUnitsPerMetre / 2;  ///< edge of a level-0 cell, in units
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
  /// true if the cost of a program grows with its box, because host fields are sampled; queries then request small
  /// boxes
  bool sampled = false;
};

class WorldField;
/// Returns a world's field without edits. The world must outlive it.
QueryField queryField(const WorldField& world);

/// A position on the surface.
struct SurfacePoint {
  std::array<double, 3> position{};
  std::array<double, 3> normal{};  ///< unit normal of the surface, which points out of the solid, like the normals of
                                   ///< mesh vertices
  double distance = 0;             ///< distance from the queried place or the start of the ray, in units
  uint16_t material = 0, tag = 0;
  bool inside = false;  ///< true if the queried place, or the start of the ray, is solid
};

/// longestRay() returns the maximum length of a ray, farthestSurface() the maximum search distance of closestPoint(),
/// in units.
int64_t longestRay(int32_t finest_cell);
int64_t farthestSurface(int32_t finest_cell);

/// Finds the first solid along the ray, up to the distance `length`. direction: any length except 0. length: 0 to
/// longestRay(). A ray that starts in the solid hits it at once (inside = true). Otherwise, the hit lies in the void,
/// less than a unit from the solid. A ray ends at the end of the world. The ray finds every solid in which it runs for
/// at least one unit and at least a sixteenth of a cell. So it misses no wall as thick as a cell; a mesh of level 0
/// shows all such walls. Interval bounds over whole stretches of the ray limit the steps: only stretches that are not
/// proven empty are sampled. So empty space costs almost nothing, and the result does not depend on the steepness of
/// the field.
Result<std::optional<SurfacePoint>> rayCast(const QueryField& field, const std::array<double, 3>& from,
                                            const std::array<double, 3>& direction, double length);

/// Finds the point of the surface that is nearest to a place, within `max_distance` (0 to farthestSurface()); nullopt
/// if there is none. Considers all of the surface that the samples of level 0 show. Usually the result is exact to a
/// unit. In any case, no other part of the surface is nearer by more than a quarter of a cell plus 1/64 of the
/// distance. The returned position lies on the same side of the surface as the place: in the void or, if the place is
/// inside the solid, in the solid.
Result<std::optional<SurfacePoint>> closestPoint(const QueryField& field, const std::array<double, 3>& place,
                                                 double max_distance);

/// The agent of isWalkable(): an upright cylinder.
struct Walker {
  double radius = 0.3 * kUnitsPerMetre;  ///< 0 to 64 cells
  double height = 1.8 * kUnitsPerMetre;  ///< height of the walker in units: above 0, at most 256 cells
  /// height in units that the walker can climb or drop from one place to the next; less than `height`
  double step = 0.4 * kUnitsPerMetre;
  /// minimum y component of the unit normal of a walkable floor, 0 to 1: the cosine of the steepest slope
  double slope = 0.7071067811865476;
  /// minimum connected floor area, in square units, for WalkableArea::walkable to be true; 0 or more
  double area = 1024.0 * 1024.0;
};

struct WalkableArea {
  bool walkable = false;  ///< true if `largest` is not 0 and at least the walker's `area`
  /// area of all floor in the box on which the walker can stand, in square units seen from above
  double standing = 0;
  double largest = 0;  ///< area of the largest connected part of the floor in `standing`
  uint8_t sides = 0;   ///< side faces of the box that the largest connected part reaches: bit (1 << Face)
};

/// Finds where a walker can stand in a box (closed, not empty) and how far it can walk, on the samples of level 0, one
/// cell apart. A place to stand is a column of samples with a floor in the box: solid under void, with a normal within
/// the slope, void up to the walker's height, and, within the walker's radius, no solid above its step and below its
/// head. Adjacent places are connected if their floors differ by no more than the step. A passage can be walked through
/// if `sides` contains both of its ends. Errors: limit if the box meets more than 4,096 chunks of 32^3 cells.
Result<WalkableArea> isWalkable(const QueryField& field, const IntBox& box, const Walker& walker);

}  // namespace sgm

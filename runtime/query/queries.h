#pragma once
// Questions to the field itself, where no mesh is: what a ray hits, what surface is nearest, where one can stand. Any
// thread; the same answer on every machine, and at any distance from the origin.
//
// Positions are in units, also between them; so are lengths and distances. Errors common to all: invalid_argument (not
// finite, or out of its stated range), range (a position outside of the world), limit (too far or too large; the
// message says what is not), and those of compiling the field.

#include <array>
#include <functional>
#include <memory>
#include <memory_resource>
#include <optional>

#include "base/result.h"
#include "field/program.h"

namespace sgm {

/// The field to ask: that of a world, edited or not, at level 0.
struct QueryField {
  /// The program of all that matters in a closed box.
  std::function<Result<std::shared_ptr<const FieldProgram>>(const IntBox&)> at;
  int32_t finest_cell = kUnitsPerMetre / 2;  ///< edge of a level-0 cell
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
  bool sampled = false;  ///< a program costs as much as its box holds cells (the host's fields): ask for small ones
};

class WorldField;
/// A world's own field, which must outlive it.
QueryField queryField(const WorldField& world);

/// A place on the surface.
struct SurfacePoint {
  std::array<double, 3> position{};
  std::array<double, 3> normal{};  ///< one long, out of the solid, as vertices have it
  double distance = 0;             ///< from where was asked
  uint16_t material = 0, tag = 0;
  bool inside = false;  ///< the place that was asked about lies in the solid itself
};

/// How far a ray may go, and how far a nearest surface may be looked for.
int64_t longestRay(int32_t finest_cell);
int64_t farthestSurface(int32_t finest_cell);

/// The first solid that the ray comes to, within `length`. A ray that starts in the solid hits it at once (inside).
/// Nothing solid is stepped over that the ray passes through for a sixteenth of a cell, or for a unit where that is
/// more; so no wall as thick as a cell, which is what a mesh of level 0 is sure to show. The hit lies on the void's
/// side, less than a unit from the solid. A ray ends where the world does. direction: any length but 0. length: 0 to
/// longestRay().
///
/// Steps are bounded by intervals over whole stretches of the ray, so that empty space costs next to nothing and
/// nothing rests on how steep the field is; only what is not proven empty is sampled.
Result<std::optional<SurfacePoint>> rayCast(const QueryField& field, const std::array<double, 3>& from,
                                            const std::array<double, 3>& direction, double length);

/// The surface nearest to a place, within `max_distance` (0 to farthestSurface()); none where there is none. Looks at
/// all of the surface that the samples of level 0 show: none of that is nearer than the answer by more than a quarter
/// of a cell and a sixty-fourth of the distance; as a rule the answer is exact to a unit. Its position has the void on
/// the side towards the place, or, asked from inside the solid, the solid.
Result<std::optional<SurfacePoint>> closestPoint(const QueryField& field, const std::array<double, 3>& place,
                                                 double max_distance);

/// Who is to stand and walk: an upright cylinder.
struct Walker {
  double radius = 0.3 * kUnitsPerMetre;  ///< 0 to 64 cells
  double height = 1.8 * kUnitsPerMetre;  ///< above 0, to 256 cells
  double step = 0.4 * kUnitsPerMetre;    ///< climbs and drops this much from one place to the next; below `height`
  double slope = 0.7071067811865476;     ///< least y of a floor's normal: the cosine of the steepest angle; 0 to 1
  double area = 1024.0 * 1024.0;         ///< square units of connected floor that make a box walkable; 0 or more
};

struct WalkableArea {
  bool walkable = false;  ///< `largest` is not 0, and is at least the walker's `area`
  double standing = 0;    ///< floor in the box that the walker can stand on, square units seen from above
  double largest = 0;     ///< of that the largest connected part
  uint8_t sides = 0;      ///< side faces of the box that the largest part comes to, bit (1 << Face)
};

/// Where in a box (closed, not empty) a walker can stand and how far it can walk. Judged on the samples of level 0, one
/// cell apart. A place to stand is a column of samples with a floor in the box: solid under void, its normal up to the
/// slope, with the walker's height free above it, and no solid within the walker's radius that is higher than its step
/// and lower than its head. Places side by side are connected where their floors differ by no more than the step. A
/// passage can be walked through where `sides` has both its ends.
/// limit: more than 4,096 chunks of 32^3 cells.
Result<WalkableArea> isWalkable(const QueryField& field, const IntBox& box, const Walker& walker);

}  // namespace sgm

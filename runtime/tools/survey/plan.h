#pragma once
// The plan of a survey: a passage seen from above, in the manner of cavers' drawings.

#include <set>

#include "tools/survey/columns.h"

namespace sgm::survey {

/// Colours of water and of its shores.
inline constexpr Ink kWater{205, 228, 246}, kShore{30, 100, 180};
/// Colour of solid objects in an open world.
inline constexpr Ink kBuilt{230, 230, 226};

/// The materials that have signs of their own in a plan, by their indices in Program::materials.
struct MaterialSigns {
  std::vector<bool> water, dripstone;
  bool isWater(uint32_t label) const { return has(water, label); }
  bool isDripstone(uint32_t label) const { return has(dripstone, label); }

 private:
  static bool has(const std::vector<bool>& kinds, uint32_t label) {
    const size_t material = label & 0xFFFF;
    return material < kinds.size() && kinds[material];
  }
};

/// A height in whole metres: "-12"; never "-0".
std::string wholeMetres(double height);

MaterialSigns signsFor(const Program& program);

/// Position and scale of a grid on the paper.
struct Placement {
  Point corner;      ///< position of the grid point (0, 0), pixels
  double scale = 1;  ///< pixels for each grid step
  Point at(Point p) const { return {corner.x + scale * p.x, corner.y + scale * p.y}; }
  Line at(const Line& line) const;
};

/// The rectangles of the paper that lettering occupies, so that texts do not overlap.
class Lettered {
 public:
  /// Whether a rectangle with this centre and size overlaps no occupied one; if so, the rectangle becomes occupied.
  bool take(Point middle, double width, double height);

 private:
  struct Room {
    Point lo, hi;
  };
  std::vector<Room> rooms_;
};

/// Figures of a plan; lengths in metres.
struct PlanFigures {
  double interval = 0;             ///< height difference between contours; 0: there are no contours
  double area = 0;                 ///< area of the subject as seen from above, m2
  double lowest = 0, highest = 0;  ///< heights of floors, or of the solid's top
  std::set<double> water;          ///< heights of water surfaces, rounded to a tenth of a metre
  size_t dripstones = 0;           ///< number of drawn signs for dripstones
  size_t leads = 0;                ///< number of places at which a passage continues beyond the region
  bool empty = true;
};

/// Heights of the surfaces that are visible from above: floors of a hollow, tops of a solid; kUnknown where there is
/// none.
Grid heightsIn(const Columns& columns);

PlanFigures drawPlan(const Columns& columns, const MaterialSigns& signs, const Placement& place, Drawing& drawing);

/// Draws floors as contours, with hachures where they are steep, and the edges of steps in the ceiling as dashed lines.
/// Returns the height difference between contours in metres; 0 if there are no contours.
double drawRelief(const Columns& columns, const MaterialSigns& signs, const Placement& place, Lettered& lettered,
                  Drawing& drawing);

/// Draws signs for stalagmites, stalactites and columns, and the outlines of larger flowstone. Returns the number of
/// signs.
size_t drawDripstone(const Columns& columns, const MaterialSigns& signs, const Placement& place, Drawing& drawing);

}  // namespace sgm::survey

#pragma once
// The plan of a survey: passages seen from above, in the style of cave maps.

#include <set>

#include "tools/survey/columns.h"

namespace sgm::survey {

/// Colours of water areas and of shorelines.
inline constexpr Ink kWater{205, 228, 246}, kShore{30, 100, 180};
/// Fill colour of solids in a plan or section of an open world.
inline constexpr Ink kBuilt{230, 230, 226};

/// Materials with a symbol of their own on a map: whether each material is water or dripstone, indexed as in
/// Program::materials.
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

/// A height rounded to whole metres, as text: "-12", and "0" instead of "-0".
std::string wholeMetres(double height);

MaterialSigns signsFor(const Program& program);

/// Maps grid coordinates to positions on the sheet.
struct Placement {
  Point corner;      ///< position on the sheet of the grid point (0, 0), pixels
  double scale = 1;  ///< pixels per grid step
  Point at(Point p) const { return {corner.x + scale * p.x, corner.y + scale * p.y}; }
  Line at(const Line& line) const;
};

/// Rectangles of the sheet that labels occupy, so that labels do not overlap.
class Lettered {
 public:
  /// Marks the rectangle with this centre and size as occupied, and returns true. If it overlaps an occupied rectangle,
  /// changes nothing and returns false.
  bool take(Point middle, double width, double height);

 private:
  struct Room {
    Point lo, hi;
  };
  std::vector<Room> rooms_;
};

/// Measures of a plan. Lengths are in metres.
struct PlanFigures {
  double interval = 0;  ///< height difference between neighbouring contours; 0 without contours
  double area = 0;      ///< area of the drawn void or solid, seen from above, square metres
  /// lowest and highest height of the drawn surface: the floor of a hollow, or the top of a solid
  double lowest = 0, highest = 0;
  std::set<double> water;  ///< heights of water surfaces, rounded to a tenth of a metre
  size_t dripstones = 0;   ///< number of dripstone symbols
  size_t leads = 0;        ///< number of places at which a passage continues beyond the region
  bool empty = true;
};

/// For each column, the height of the surface seen from above: the floor of a hollow or the top of a solid; kUnknown if
/// the column has no such surface, or if the region's floor or ceiling cuts it off.
Grid heightsIn(const Columns& columns);

PlanFigures drawPlan(const Columns& columns, const MaterialSigns& signs, const Placement& place, Drawing& drawing);

/// Draws the floors as contours, with hachures on steep slopes, and steps of the ceiling as dashed lines. Returns the
/// height difference between neighbouring contours in metres; 0 if it draws no contours.
double drawRelief(const Columns& columns, const MaterialSigns& signs, const Placement& place, Lettered& lettered,
                  Drawing& drawing);

/// Draws symbols for stalagmites, stalactites and columns, and outlines of large flowstone. Returns the number of
/// symbols.
size_t drawDripstone(const Columns& columns, const MaterialSigns& signs, const Placement& place, Drawing& drawing);

}  // namespace sgm::survey

#pragma once
// A survey's plan: a caver's drawing of a passage, seen from above.

#include <set>

#include "tools/survey/columns.h"

namespace sgm::survey {

/// Colours of water and of its edges.
inline constexpr Ink kWater{205, 228, 246}, kShore{30, 100, 180};
/// Colour of solid objects.
inline constexpr Ink kBuilt{230, 230, 226};

/// Materials with signs, by index in Program::materials.
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

/// "-12"; never "-0".
std::string wholeMetres(double height);

MaterialSigns signsFor(const Program& program);

/// Placement of a grid on the paper.
struct Placement {
  Point corner;      ///< place of its point (0, 0)
  double scale = 1;  ///< pixels per step
  Point at(Point p) const { return {corner.x + scale * p.x, corner.y + scale * p.y}; }
  Line at(const Line& line) const;
};

/// Rectangles of the paper that letters occupy.
class Lettered {
 public:
  /// Whether a rectangle around the middle is free; if so, occupies it.
  bool take(Point middle, double width, double height);

 private:
  struct Room {
    Point lo, hi;
  };
  std::vector<Room> rooms_;
};

/// Numbers of a plan; metres.
struct PlanFigures {
  double interval = 0;             ///< between contours; 0: no contours
  double area = 0;                 ///< of the subject seen from above, m2
  double lowest = 0, highest = 0;  ///< of floors, or of the solid's top
  std::set<double> water;          ///< levels, to a tenth
  size_t dripstones = 0;           ///< signs drawn
  size_t leads = 0;                ///< places where a passage continues beyond the region
  bool empty = true;
};

/// Heights of surfaces visible from above: floors of the hollow, tops of the solid; kUnknown elsewhere.
Grid heightsIn(const Columns& columns);

PlanFigures drawPlan(const Columns& columns, const MaterialSigns& signs, const Placement& place, Drawing& drawing);

/// Draws floors by contours, with hachures where they are steep, and ceilings by dashes at their steps. Returns the
/// contour interval in metres; 0 without contours.
double drawRelief(const Columns& columns, const MaterialSigns& signs, const Placement& place, Lettered& lettered,
                  Drawing& drawing);

/// Draws signs for stalagmites, stalactites and columns, and outlines of larger flowstone. Returns the number of signs.
size_t drawDripstone(const Columns& columns, const MaterialSigns& signs, const Placement& place, Drawing& drawing);

}  // namespace sgm::survey

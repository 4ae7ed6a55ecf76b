#pragma once
// A survey's plan: what a caver draws of a passage, seen from above.

#include <set>

#include "tools/survey/columns.h"

namespace sgm::survey {

/// Of water on paper, and of its edges.
inline constexpr Ink kWater{205, 228, 246}, kShore{30, 100, 180};
/// Of what stands.
inline constexpr Ink kBuilt{230, 230, 226};

/// What materials mean on paper, by index in Program::materials.
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

/// Where a grid lies on the paper.
struct Placement {
  Point corner;      ///< of its point (0, 0)
  double scale = 1;  ///< pixels a step
  Point at(Point p) const { return {corner.x + scale * p.x, corner.y + scale * p.y}; }
  Line at(const Line& line) const;
};

/// Rectangles of the paper that letters have taken.
class Lettered {
 public:
  /// Whether a rectangle around the middle is free; it is taken from then on.
  bool take(Point middle, double width, double height);

 private:
  struct Room {
    Point lo, hi;
  };
  std::vector<Room> rooms_;
};

/// What a plan says in numbers; metres.
struct PlanFigures {
  double interval = 0;             ///< between contours; 0: there are none
  double area = 0;                 ///< of the subject seen from above, m2
  double lowest = 0, highest = 0;  ///< of floors, or of the solid's top
  std::set<double> water;          ///< levels, to a tenth
  size_t dripstones = 0;           ///< signs drawn
  size_t leads = 0;                ///< places where a passage goes on beyond the region
  bool empty = true;
};

/// Heights of what a plan looks down at: floors of the hollow, tops of the solid; kUnknown elsewhere.
Grid heightsIn(const Columns& columns);

PlanFigures drawPlan(const Columns& columns, const MaterialSigns& signs, const Placement& place, Drawing& drawing);

/// Floors by lines of one height with hachures where they are steep, ceilings by dashes where they step. Returns the
/// metres between two lines; 0 if there are none.
double drawRelief(const Columns& columns, const MaterialSigns& signs, const Placement& place, Lettered& lettered,
                  Drawing& drawing);

/// Signs for stalagmites, stalactites and columns; outlines around larger flowstone. Returns how many signs there are.
size_t drawDripstone(const Columns& columns, const MaterialSigns& signs, const Placement& place, Drawing& drawing);

}  // namespace sgm::survey

#pragma once
// A survey's long section: floor and ceiling where a line cuts the passage, and the outline of parts beyond the line.

#include "tools/survey/plan.h"
#include "tools/survey/slice.h"

namespace sgm::survey {

/// The drawn part of a slice: samples from lo to hi, both included.
struct Crop {
  int left = 0, right = 0, top = 0, bottom = 0;
};

/// All of the subject, on the cut or beyond it, with a margin; the whole slice if it has no subject.
Crop cropOf(const Slice& slice);

struct SectionFigures {
  double area = 0;  ///< of the subject that the line cuts, m2
  double lowest = 0, highest = 0;
  bool empty = true;
};

/// Draws the crop with the slice's sample (0, 0) at the placement's corner; heights are on its left.
SectionFigures drawSection(const Slice& slice, const Crop& crop, const MaterialSigns& signs, const Placement& place,
                           Drawing& drawing);

}  // namespace sgm::survey

#pragma once
// The long section of a survey: floor and ceiling where a vertical cut meets the passage, and the outline of the parts
// of the passage that lie beyond the cut.

#include "tools/survey/plan.h"
#include "tools/survey/slice.h"

namespace sgm::survey {

/// The part of a slice that is drawn: columns left to right and rows top to bottom, all included.
struct Crop {
  int left = 0, right = 0, top = 0, bottom = 0;
};

/// The crop with all of the subject, on the cut or beyond it, and a margin; the whole slice if it contains no subject.
Crop cropOf(const Slice& slice);

struct SectionFigures {
  double area = 0;  ///< area in which the cut meets the subject, m2
  double lowest = 0, highest = 0;
  bool empty = true;
};

/// Draws the crop. The placement gives the position of the slice's sample (0, 0); a scale of heights is drawn on the
/// left.
SectionFigures drawSection(const Slice& slice, const Crop& crop, const MaterialSigns& signs, const Placement& place,
                           Drawing& drawing);

}  // namespace sgm::survey

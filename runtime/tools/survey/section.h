#pragma once
// The long section of a survey: a vertical cut along a passage, with the outline of the passages in front of and behind
// the cut.

#include "tools/survey/plan.h"
#include "tools/survey/slice.h"

namespace sgm::survey {

/// The part of a slice that is drawn: the columns left..right and the rows top..bottom, both ends included.
struct Crop {
  int left = 0, right = 0, top = 0, bottom = 0;
};

/// The smallest crop that contains the subject (the void or the solid that is drawn), both on the cut and projected
/// onto it from in front and behind, plus a margin. The whole slice if it does not contain the subject.
Crop cropOf(const Slice& slice);

struct SectionFigures {
  double area = 0;  ///< area of the subject (the void or solid that is drawn) on the cut, square metres
  double lowest = 0, highest = 0;
  bool empty = true;
};

/// Draws the cropped slice, with a scale of heights on its left. place: position of the slice's sample (0, 0), and
/// scale.
SectionFigures drawSection(const Slice& slice, const Crop& crop, const MaterialSigns& signs, const Placement& place,
                           Drawing& drawing);

}  // namespace sgm::survey

#pragma once
// A sheet of paper with a plan, a long section, or both at one scale; a title, a scale bar, and a north arrow.

#include <optional>

#include "tools/survey/section.h"

namespace sgm::survey {

struct SheetWish {
  int width = 1600, height = 1200;  ///< pixels
  bool plan = true;                 ///< if false, the section alone
  std::string title;                ///< "cave.sgm"
  std::string subtitle;             ///< seed and region
};

struct SheetFigures {
  double scale = 0;  ///< pixels per metre
  PlanFigures plan;
  SectionFigures section;
};

/// Minimal width and height of a sheet, pixels.
inline constexpr int kLeastSheet = 320;

/// slice: null: the plan alone. Contract: the plan or the slice is requested, and the sheet has at least kLeastSheet
/// pixels on each edge.
Drawing drawSheet(const Columns& columns, const Slice* slice, const MaterialSigns& signs, const SheetWish& wish,
                  SheetFigures& figures);

}  // namespace sgm::survey

#pragma once
// A sheet of paper with a plan, a long section, or both in one scale; a title, a scale bar, an arrow to the north.

#include <optional>

#include "tools/survey/section.h"

namespace sgm::survey {

struct SheetWish {
  int width = 1600, height = 1200;  ///< pixels
  bool plan = true;                 ///< otherwise the section alone
  std::string title;                ///< "cave.sgm"
  std::string subtitle;             ///< seed and region
};

struct SheetFigures {
  double scale = 0;  ///< pixels a metre
  PlanFigures plan;
  SectionFigures section;
};

/// Pixels that a sheet has at least, on each edge.
inline constexpr int kLeastSheet = 320;

/// slice: null: the plan alone. Contract: the plan or the slice is asked for, and the sheet is kLeastSheet wide and
/// high at least.
Drawing drawSheet(const Columns& columns, const Slice* slice, const MaterialSigns& signs, const SheetWish& wish,
                  SheetFigures& figures);

}  // namespace sgm::survey

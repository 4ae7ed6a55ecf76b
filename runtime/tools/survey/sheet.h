#pragma once
// A sheet of paper with a plan, a long section, or both at the same scale; with a title, a scale bar, and a north
// arrow.

#include <optional>

#include "tools/survey/section.h"

namespace sgm::survey {

struct SheetRequest {
  int width = 1600, height = 1200;  ///< size of the sheet in pixels
  bool plan = true;                 ///< draws a plan; if false, the section alone
  std::string title;                ///< text such as "cave.sgm"
  std::string subtitle;             ///< text with seed and region
};

struct SheetFigures {
  double scale = 0;  ///< pixels for each metre
  PlanFigures plan;
  SectionFigures section;
};

/// Minimum width and height of a sheet, pixels.
inline constexpr int kLeastSheet = 320;

/// Draws the sheet. slice: the section to draw; null: the plan alone. Contract: wish.plan is set or slice is not null,
/// and each edge of the sheet has at least kLeastSheet pixels.
Drawing drawSheet(const Columns& columns, const Slice* slice, const MaterialSigns& signs, const SheetRequest& request,
                  SheetFigures& figures);

}  // namespace sgm::survey

#pragma once
// A sheet with a plan, a section, or both at the same scale, and with a title, a scale bar and a north arrow.

#include <optional>

#include "tools/survey/section.h"

namespace sgm::survey {

struct SheetRequest {
  int width = 1600, height = 1200;  ///< pixels, size of the sheet
  bool plan = true;                 ///< whether a plan is drawn; if false, only the section
  std::string title;                ///< title of the sheet, such as "cave.sgm"
  std::string subtitle;             ///< second line of the title, with seed and region
};

struct SheetFigures {
  double scale = 0;  ///< pixels per metre
  PlanFigures plan;
  SectionFigures section;
};

/// Minimum width and height of a sheet in pixels.
inline constexpr int kLeastSheet = 320;

/// Draws the sheet. slice: the section to draw, or null for none. Contract: request.plan is true or slice is not null,
/// and the sheet has at least kLeastSheet pixels in width and height.
Drawing drawSheet(const Columns& columns, const Slice* slice, const MaterialSigns& signs, const SheetRequest& request,
                  SheetFigures& figures);

}  // namespace sgm::survey

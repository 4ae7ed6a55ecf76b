#include "tools/survey/sheet.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "tools/survey/lettering.h"

namespace sgm::survey {
namespace {

constexpr double kMargin = 40, kFooter = 110, kCaption = 24, kBetween = 56, kHeights = 34;  // pixels: margins and gaps
                                                                                            // of the sheet
constexpr double kTitle = 15, kText = 8, kAbove = 20;
constexpr double kAroundPlan = 2;  // metres, margin around the drawn part of the plan

/// The part of the columns that the plan draws: all columns that meet the void or solid to draw, plus a margin.
Crop planCrop(const Columns& columns) {
  const Grid& widest = columns.widest;
  Crop crop{widest.width, -1, widest.height, -1};
  for (int z = 0; z < widest.height; ++z) {
    for (int x = 0; x < widest.width; ++x) {
      if (!(widest.at(x, z) > 0)) continue;
      crop.left = std::min(crop.left, x), crop.right = std::max(crop.right, x);
      crop.top = std::min(crop.top, z), crop.bottom = std::max(crop.bottom, z);
    }
  }
  if (crop.right < 0) return {0, widest.width - 1, 0, widest.height - 1};
  const int around = static_cast<int>(std::ceil(kAroundPlan / metres(columns.step)));
  return {std::max(0, crop.left - around), std::min(widest.width - 1, crop.right + around),
          std::max(0, crop.top - around), std::min(widest.height - 1, crop.bottom + around)};
}

struct Extent {
  double wide = 0, high = 0;  ///< metres, size of a plan or section
};

Extent extentOf(const Crop& crop, double step) {
  return {std::max(1, crop.right - crop.left) * step, std::max(1, crop.bottom - crop.top) * step};
}

/// Scale and positions of the plan and the section on the sheet.
struct Layout {
  double scale = 0;     ///< pixels per metre
  Point plan, section;  ///< positions of the upper left corners of the plan and the section, pixels
};

/// Arranges the plan and the section below or beside each other, whichever allows the larger scale.
Layout arrange(const SheetRequest& request, const Extent* plan, const Extent* section) {
  const double wide = request.width - 2 * kMargin, high = request.height - 2 * kMargin - kFooter - kCaption;
  Layout layout;
  const double gutter = section != nullptr ? kHeights : 0;
  if (plan == nullptr || section == nullptr) {
    const Extent& one = plan != nullptr ? *plan : *section;
    layout.scale = std::min((wide - gutter) / one.wide, high / one.high);
    const Point corner{kMargin + gutter + (wide - gutter - layout.scale * one.wide) / 2,
                       kMargin + kCaption + (high - layout.scale * one.high) / 2};
    layout.plan = layout.section = corner;
    return layout;
  }
  const double below = std::min((wide - gutter) / std::max(plan->wide, section->wide),
                                (high - kBetween - kCaption) / (plan->high + section->high));
  const double beside =
      std::min((wide - gutter - kBetween) / (plan->wide + section->wide), high / std::max(plan->high, section->high));
  layout.scale = std::max({below, beside, 1e-6});
  const double s = layout.scale;
  if (below >= beside) {
    const double top = kMargin + kCaption + (high - kBetween - kCaption - s * (plan->high + section->high)) / 2;
    const double left = kMargin + gutter + (wide - gutter - s * std::max(plan->wide, section->wide)) / 2;
    layout.plan = {left, top};
    layout.section = {left, top + s * plan->high + kBetween + kCaption};
  } else {
    const double left = kMargin + (wide - gutter - kBetween - s * (plan->wide + section->wide)) / 2;
    const double top = kMargin + kCaption + (high - s * std::max(plan->high, section->high)) / 2;
    layout.plan = {left, top};
    layout.section = {left + s * plan->wide + kBetween + gutter, top};
  }
  return layout;
}

void drawScaleBar(const Layout& layout, Point at, Drawing& drawing) {
  double length = 1;
  for (const double nice : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0}) {
    if (nice * layout.scale > 230) break;
    length = nice;
  }
  constexpr int kParts = 5;
  const double part = length * layout.scale / kParts;
  Mark dark{"scale", {}, true, kBlack, 1, {}, {}}, frame{"scale_frame", {}, false, kBlack, 0.8, {}, {}};
  for (int i = 0; i < kParts; ++i) {
    const double x = at.x + i * part;
    const Line box{{x, at.y}, {x + part, at.y}, {x + part, at.y + 6}, {x, at.y + 6}, {x, at.y}};
    (i % 2 == 0 ? dark : frame).lines.push_back(box);
  }
  frame.lines.push_back(
      {{at.x, at.y}, {at.x + kParts * part, at.y}, {at.x + kParts * part, at.y + 6}, {at.x, at.y + 6}, {at.x, at.y}});
  drawing.marks.push_back(std::move(dark));
  drawing.marks.push_back(std::move(frame));
  drawing.marks.push_back(lettering("0", {at.x, at.y - 5}, kText - 1, Align::middle));
  drawing.marks.push_back(
      lettering(fmt::format("{:g} m", length), {at.x + kParts * part, at.y - 5}, kText - 1, Align::middle));
}

/// Draws the north arrow, which points up: north is the world's -z.
void drawNorth(Point at, Drawing& drawing) {
  drawing.marks.push_back({"north", {{{at.x, at.y + 40}, {at.x, at.y}}}, false, kBlack, 1.2, {}, {}});
  drawing.marks.push_back(
      {"north", {{{at.x, at.y - 6}, {at.x - 6, at.y + 12}, {at.x, at.y + 7}}}, true, kBlack, 1, {}, {}});
  drawing.marks.push_back({"north",
                           {{{at.x, at.y - 6}, {at.x + 6, at.y + 12}, {at.x, at.y + 7}, {at.x, at.y - 6}}},
                           false,
                           kBlack,
                           0.8,
                           {},
                           {}});
  drawing.marks.push_back(lettering("N", {at.x, at.y - 12}, kText + 2, Align::middle));
}

/// Draws the line of the section into the plan, with the letters A and A' at its ends.
void drawCutLine(const Columns& columns, const Slice& slice, const Crop& crop, const Placement& place,
                 Drawing& drawing) {
  const double length = slice.line.length();
  const auto at = [&](int sample) {
    const double share = sample * slice.step / length, step = metres(columns.step);
    const double x = slice.line.x0 + share * (slice.line.x1 - slice.line.x0),
                 z = slice.line.z0 + share * (slice.line.z1 - slice.line.z0);
    return place.at(Point{(x - columns.xAt(0)) / step, (z - columns.zAt(0)) / step});
  };
  const Point a = at(crop.left), b = at(crop.right);
  drawing.marks.push_back({"cut", {{a, b}}, false, Ink{180, 40, 40}, 0.9, {12, 4, 2, 4}, {}});
  const double across = std::hypot(b.x - a.x, b.y - a.y);
  const Point way{(b.x - a.x) / across, (b.y - a.y) / across};
  drawing.marks.push_back(
      lettering("A", {a.x - 12 * way.x, a.y - 12 * way.y + 5}, kText + 2, Align::middle, Ink{180, 40, 40}));
  drawing.marks.push_back(
      lettering("A'", {b.x + 12 * way.x, b.y + 12 * way.y + 5}, kText + 2, Align::middle, Ink{180, 40, 40}));
}

std::string legend(const Columns& columns, const SheetFigures& figures, bool plan, bool section) {
  const bool hollow = columns.subject == Subject::hollow;
  std::vector<std::string> parts;
  if (plan && figures.plan.interval > 0)
    parts.push_back(fmt::format("contours of the {} every {:g} m, hachures downhill", hollow ? "floor" : "top",
                                figures.plan.interval));
  if (plan && !hollow) parts.push_back("numbers: height of the top");
  if (plan && hollow) {
    parts.push_back("dashed: ceiling steps, passages below");
    parts.push_back("numbers: height of the floor, blue: of water; in circles: height of the passage");
    if (figures.plan.dripstones > 0) parts.push_back("Y: dripstone, hanging; turned over: standing");
    if (figures.plan.leads > 0) parts.push_back("?: continues");
  }
  if (section)
    parts.push_back(hollow ? "grey in the section: passage beyond the line" : "grey outline: beyond the line");
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// Breaks a text at spaces into lines of at most `width` pixels. height: height of capital letters.
std::vector<std::string> wrapped(const std::string& text, double height, double width) {
  std::vector<std::string> lines{""};
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    std::string& line = lines.back();
    if (!line.empty() && letterWidth(line + " " + word, height) > width)
      lines.push_back(word);
    else
      line += (line.empty() ? "" : " ") + word;
    at = end + 1;
  }
  return lines;
}

void drawFooter(const Columns& columns, const Layout& layout, const SheetRequest& request, bool section,
                const SheetFigures& figures, Drawing& drawing) {
  const double top = request.height - kMargin - kFooter + 38, right = request.width - kMargin;
  drawing.marks.push_back({"frame", {{{kMargin, top - 12}, {right, top - 12}}}, false, kBlack, 0.8, {}, {}});
  const bool hollow = columns.subject == Subject::hollow;
  const char* what = !request.plan ? "long section" : section ? "plan and long section" : "plan";
  std::string heading = fmt::format("{} - {}", request.title, what);
  double height = kTitle;
  while (height > 5 && letterWidth(heading, height) > right - kMargin - 280) --height;
  drawing.marks.push_back(lettering(heading, {kMargin, top + kTitle + 2}, height));
  std::string facts = request.subtitle;
  if (request.plan && !figures.plan.empty)
    facts += fmt::format("; {} {} to {} m, area {:.0f} sq m", hollow ? "floors from" : "tops from",
                         wholeMetres(figures.plan.lowest), wholeMetres(figures.plan.highest), figures.plan.area);
  double y = top + kTitle + 20;
  const std::string words = legend(columns, figures, request.plan, section);
  for (const std::string* text : {static_cast<const std::string*>(&facts), &words}) {
    for (const std::string& line : wrapped(*text, kText - 1, right - kMargin - 300)) {
      if (line.empty()) continue;
      drawing.marks.push_back(lettering(line, {kMargin, y}, kText - 1));
      y += 14;
    }
  }
  drawScaleBar(layout, {right - 250, top + 22}, drawing);
  drawing.marks.push_back(lettering("heights in metres", {right - 250, top + 50}, kText - 1));
}

}  // namespace

Drawing drawSheet(const Columns& columns, const Slice* slice, const MaterialSigns& signs, const SheetRequest& request,
                  SheetFigures& figures) {
  Drawing drawing{request.width, request.height, {}};
  const Crop of_plan = planCrop(columns), of_section = slice != nullptr ? cropOf(*slice) : Crop{};
  const Extent plan = extentOf(of_plan, metres(columns.step)),
               section = slice != nullptr ? extentOf(of_section, slice->step) : Extent{};
  const Layout layout = arrange(request, request.plan ? &plan : nullptr, slice != nullptr ? &section : nullptr);
  figures.scale = layout.scale;
  const auto placement = [&](Point corner, const Crop& crop, double step) {
    const double scale = layout.scale * step;
    return Placement{{corner.x - scale * crop.left, corner.y - scale * crop.top}, scale};
  };
  if (request.plan) {
    const Placement place = placement(layout.plan, of_plan, metres(columns.step));
    figures.plan = drawPlan(columns, signs, place, drawing);
    if (slice != nullptr) drawCutLine(columns, *slice, of_section, place, drawing);
    drawing.marks.push_back(lettering("PLAN", {layout.plan.x, layout.plan.y - kAbove}, kText));
    drawNorth({std::min(layout.plan.x + layout.scale * plan.wide + 24, request.width - 24.0), kMargin + 16}, drawing);
  }
  if (slice != nullptr) {
    figures.section =
        drawSection(*slice, of_section, signs, placement(layout.section, of_section, slice->step), drawing);
    drawing.marks.push_back(lettering(request.plan ? "LONG SECTION  A - A'" : "LONG SECTION",
                                      {layout.section.x, layout.section.y - kAbove}, kText));
  }
  drawFooter(columns, layout, request, slice != nullptr, figures, drawing);
  return drawing;
}

}  // namespace sgm::survey

#include "tools/survey/section.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/survey/lettering.h"

namespace sgm::survey {
namespace {

constexpr Ink kBeyond{240, 240, 240}, kOutline{150, 150, 150}, kGuide{215, 215, 215};
constexpr double kStrip = 9;  // height, in pixels, of the strip that represents water below its surface
constexpr int kAround = 4;    // margin around the drawn part of the slice, in samples
// Distance between ticks along an outline, in pixels. Ticks are strokes that show on which side the rock is.
constexpr double kTickGap = 7;
constexpr double kTick = 6;        // length of a tick, in pixels
constexpr double kHeightGap = 36;  // minimum distance between two height labels, in pixels

void drawGuides(const Slice& slice, const Crop& crop, const Placement& place, Drawing& drawing) {
  const double metre = place.scale / slice.step;
  double gap = 1;
  for (const double nice : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0}) {
    gap = nice;
    if (gap * metre >= kHeightGap) break;
  }
  const double left = place.at(Point{static_cast<double>(crop.left), 0}).x,
               right = place.at(Point{static_cast<double>(crop.right), 0}).x;
  const double high = slice.heightAt(crop.top), low = slice.heightAt(crop.bottom);
  Mark guides{"guide", {}, false, kGuide, 0.6, {}, {}}, ticks{"tick", {}, false, kBlack, 1, {}, {}};
  ticks.lines.push_back({{left - 6, place.at(Point{0, static_cast<double>(crop.top)}).y},
                         {left - 6, place.at(Point{0, static_cast<double>(crop.bottom)}).y}});
  Drawing letters;
  for (double height = std::ceil(low / gap) * gap; height <= high; height += gap) {
    const double y = place.at(Point{0, (slice.top - height) / slice.step}).y;
    guides.lines.push_back({{left, y}, {right, y}});
    ticks.lines.push_back({{left - 10, y}, {left - 6, y}});
    letters.marks.push_back(lettering(fmt::format("{:g}", height + 0.0), {left - 13, y + 3.5}, 7, Align::right));
  }
  drawing.marks.push_back(std::move(guides));
  drawing.marks.push_back(std::move(ticks));
  for (Mark& mark : letters.marks) drawing.marks.push_back(std::move(mark));
}

/// A grid for contours of the water in a slice: 1 at samples in water, otherwise -1.
Grid waterOf(const Slice& slice, const MaterialSigns& signs) {
  Grid water(slice.depth.width, slice.depth.height, -1);
  for (size_t i = 0; i < water.values.size(); ++i)
    if (signs.isWater(slice.label[i])) water.values[i] = 1;
  return water;
}

/// Whether one of the four samples around a point of the outline is water.
bool isByWater(const Grid& water, Point p) {
  const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y));
  for (int dy = 0; dy <= 1; ++dy)
    for (int dx = 0; dx <= 1; ++dx)
      if (water.holds(x + dx, y + dy) && water.at(x + dx, y + dy) > 0) return true;
  return false;
}

/// Draws ticks: short strokes from a line into the rock. left: whether the rock is on the left of the line.
void tick(const Line& line, bool left, Mark& ticks) {
  double since = kTickGap / 2;
  const double side = left ? 1 : -1;
  for (size_t i = 1; i < line.size(); ++i) {
    const Point &a = line[i - 1], &b = line[i];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    double at = kTickGap - since;
    for (; length > 0 && at <= length; at += kTickGap) {
      const Point along{(b.x - a.x) / length, (b.y - a.y) / length}, into{side * along.y, -side * along.x};
      const Point from{a.x + at * along.x, a.y + at * along.y};
      // Slant the strokes, as is usual for rock in sections.
      ticks.lines.push_back({from,
                             {from.x + kTick * (0.8 * into.x + 0.6 * side * along.x),
                              from.y + kTick * (0.8 * into.y + 0.6 * side * along.y)}});
    }
    since = length - (at - kTickGap);
  }
}

/// The part of a slice's grid that the crop selects.
Grid cropped(const Grid& grid, const Crop& crop) {
  Grid part(crop.right - crop.left + 1, crop.bottom - crop.top + 1, 0);
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) part.at(x, y) = grid.at(crop.left + x, crop.top + y);
  return part;
}

}  // namespace

Crop cropOf(const Slice& slice) {
  Crop crop{slice.depth.width, -1, slice.depth.height, -1};
  for (int y = 0; y < slice.depth.height; ++y) {
    for (int x = 0; x < slice.depth.width; ++x) {
      if (!(slice.depth.at(x, y) > 0 || slice.beyond.at(x, y) > 0)) continue;
      crop.left = std::min(crop.left, x), crop.right = std::max(crop.right, x);
      crop.top = std::min(crop.top, y), crop.bottom = std::max(crop.bottom, y);
    }
  }
  if (crop.right < 0) return {0, slice.depth.width - 1, 0, slice.depth.height - 1};
  crop.left = std::max(0, crop.left - kAround), crop.top = std::max(0, crop.top - kAround);
  crop.right = std::min(slice.depth.width - 1, crop.right + kAround);
  crop.bottom = std::min(slice.depth.height - 1, crop.bottom + kAround);
  return crop;
}

SectionFigures drawSection(const Slice& slice, const Crop& crop, const MaterialSigns& signs, const Placement& place,
                           Drawing& drawing) {
  SectionFigures figures;
  figures.area = slice.step * slice.step * squaresAbove(slice.depth);
  for (int y = 0; y < slice.depth.height; ++y) {
    for (int x = 0; x < slice.depth.width; ++x) {
      if (!(slice.depth.at(x, y) > 0)) continue;
      if (figures.empty) figures.highest = slice.heightAt(y);
      figures.lowest = slice.heightAt(y);
      figures.empty = false;
    }
  }
  const Placement within{place.at(Point{static_cast<double>(crop.left), static_cast<double>(crop.top)}), place.scale};
  const auto area = [&](const Grid& grid, std::string_view name, Ink ink, bool smooth) {
    Mark mark{name, {}, true, ink, 1, {}, {}};
    for (const Line& ring : areasAbove(grid, 0)) mark.lines.push_back(within.at(smooth ? smoothed(ring) : ring));
    if (!mark.lines.empty()) drawing.marks.push_back(std::move(mark));
  };
  const bool hollow = slice.subject == Subject::hollow;
  Grid beyond = cropped(slice.beyond, crop);
  soften(beyond, 1);
  area(beyond, "beyond", kBeyond, true);
  Mark outline{"beyond_outline", {}, false, kOutline, 0.7, {}, {}};
  for (const Line& line : contours(beyond, 0))
    if (lengthOf(line) * place.scale > 20) outline.lines.push_back(within.at(smoothed(line)));
  if (!outline.lines.empty()) drawing.marks.push_back(std::move(outline));
  drawGuides(slice, crop, place, drawing);

  const Grid depth = cropped(slice.depth, crop), water = cropped(waterOf(slice, signs), crop);
  area(depth, hollow ? "hollow" : "solid", hollow ? kWhite : kBuilt, false);
  Mark wall{"wall", {}, false, kBlack, 2.2, {}, {}}, shore{"shore", {}, false, kShore, 1, {}, {}};
  Mark ticks{"rock", {}, false, kBlack, 0.7, {}, {}}, body{"water", {}, true, kWater, 1, {}, {}};
  const auto isWet = [&](const Point& p) { return isByWater(water, p); };
  const auto isDry = [&](const Point& p) { return !isByWater(water, p); };
  for (const Line& line : contours(depth, 0)) {
    if (lengthOf(line) * place.scale < 3) continue;
    for (const Line& part : partsOf(line, isDry)) {
      wall.lines.push_back(within.at(part));
      tick(wall.lines.back(), hollow, ticks);
    }
    for (const Line& part : partsOf(line, isWet)) {
      shore.lines.push_back(within.at(part));
      // Draw only a strip of water: its depth is unknown, since the shape of the water also fills the rock below.
      Line strip = shore.lines.back();
      for (size_t i = strip.size(); i-- > 0;) strip.push_back({strip[i].x, strip[i].y + kStrip});
      body.lines.push_back(std::move(strip));
    }
  }
  for (Mark* mark : {&body, &ticks, &shore, &wall})
    if (!mark->lines.empty()) drawing.marks.push_back(std::move(*mark));
  return figures;
}

}  // namespace sgm::survey

// Draws the relief of a plan: contours and hachures of floors, steps of ceilings, and symbols for dripstone.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/survey/lettering.h"
#include "tools/survey/plan.h"

namespace sgm::survey {
namespace {

constexpr Ink kContour{110, 110, 110}, kCeiling{60, 60, 60};
constexpr double kMaxLevels = 14;
constexpr double kSteep = 0.75;       // minimum slope (rise over run) of a floor with hachures
constexpr double kCeilingStep = 1.6;  // minimum slope (rise over run) of a step in the ceiling
constexpr double kFloorAbove = 1.8;   // metres; a hachure is drawn only if there is still floor at this horizontal
                                      // distance uphill
constexpr double kHachureGap = 6;     // pixels between hachures along a contour
constexpr int kMainEvery = 5;         // every kMainEvery-th contour is a main contour
// Minimum distance between contours in pixels. On steeper slopes, only main contours are drawn.
constexpr double kLeastApart = 4;
constexpr double kLongestHachure = 7;  // pixels, maximum length of a hachure
constexpr double kFlowstone = 6;       // square metres; larger flowstone gets an outline instead of a symbol

double niceInterval(double range) {
  for (const double interval : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0})
    if (range / interval <= kMaxLevels) return interval;
  return 200;
}

/// Gradient of a grid of heights at a point: points uphill, and its length is the slope (rise over run).
Point slopeAt(const Grid& heights, Point p, double step) {
  constexpr double kReach = 1;
  const auto at = [&](double dx, double dy) { return static_cast<double>(heights.between({p.x + dx, p.y + dy})); };
  const Point slope{(at(kReach, 0) - at(-kReach, 0)) / (2 * kReach * step),
                    (at(0, kReach) - at(0, -kReach)) / (2 * kReach * step)};
  return std::isnan(slope.x) || std::isnan(slope.y) ? Point{} : slope;
}

/// Draws hachures (short strokes downhill) along a contour. A hachure is drawn only if there is still floor further
/// uphill: otherwise the slope is the foot of a wall.
void hachure(const Line& line, const Grid& heights, const Grid& within, double step, double interval,
             const Placement& place, Mark& ticks) {
  double since = kHachureGap / 2;
  for (size_t i = 1; i < line.size(); ++i) {
    since += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y) * place.scale;
    if (since < kHachureGap) continue;
    since = 0;
    const Point slope = slopeAt(heights, line[i], step);
    const double steepness = std::hypot(slope.x, slope.y);
    if (steepness < kSteep) continue;
    const double uphill = kFloorAbove / step / steepness;
    if (!(within.between({line[i].x + uphill * slope.x, line[i].y + uphill * slope.y}) > 0)) continue;
    // Keep the hachure shorter than the distance to the next contour.
    const double apart = interval / steepness / step * place.scale, length = std::min(kLongestHachure, 0.8 * apart);
    if (length < 2) continue;
    const Point from = place.at(line[i]);
    ticks.lines.push_back({from, {from.x - length * slope.x / steepness, from.y - length * slope.y / steepness}});
  }
}

/// Writes the height of a contour at the line's middle, if there is room.
void letter(const Line& line, double level, const Placement& place, Lettered& lettered, Drawing& letters) {
  if (lengthOf(line) * place.scale < 90) return;
  const Point middle = place.at(line[line.size() / 2]);
  const std::string text = fmt::format("{:g}", level);
  if (!lettered.take(middle, letterWidth(text, 6) + 6, 10)) return;
  Mark mark = lettering(text, {middle.x, middle.y + 3}, 6, Align::middle, kContour);
  Mark halo = mark;
  halo.name = "halo";
  halo.text.clear();
  halo.ink = kWhite;
  halo.width += 4;
  letters.marks.push_back(std::move(halo));
  letters.marks.push_back(std::move(mark));
}

void drawFloors(const Columns& columns, Grid heights, const Grid& within, double interval, const Placement& place,
                Lettered& lettered, Drawing& drawing) {
  float low = 1e9f, high = -1e9f;
  for (const float height : heights.values)
    if (!std::isnan(height)) low = std::min(low, height), high = std::max(high, height);
  // Extend the heights by one step beyond the floor, so that contours reach the walls, where they are clipped.
  spread(heights, 1);
  Mark contour{"contour", {}, false, kContour, 0.5, {}, {}}, main{"main_contour", {}, false, kContour, 0.9, {}, {}};
  Mark ticks{"hachure", {}, false, kBlack, 0.7, {}, {}};
  Drawing letters;
  const double step = metres(columns.step);
  const auto inside = [&](const Point& p) { return within.between(p) > 0; };
  const auto first = static_cast<int>(std::ceil(static_cast<double>(low) / interval)),
             last = static_cast<int>(std::floor(static_cast<double>(high) / interval));
  const auto isClear = [&](const Point& p) {
    const Point slope = slopeAt(heights, p, step);
    return interval / std::hypot(slope.x, slope.y) / step * place.scale >= kLeastApart;
  };
  for (int i = first; i <= last; ++i) {
    const bool is_main = i % kMainEvery == 0;
    // Draw the contour slightly above its nominal level: flat floors often lie exactly at whole metres.
    for (const Line& whole : contours(heights, static_cast<float>(i * interval + 0.01))) {
      for (const Line& line :
           partsOf(smoothed(whole), [&](const Point& p) { return inside(p) && (is_main || isClear(p)); })) {
        if (lengthOf(line) * place.scale < 8) continue;
        hachure(line, heights, within, step, is_main ? kMainEvery * interval : interval, place, ticks);
        if (is_main) letter(line, i * interval, place, lettered, letters);
        (is_main ? main : contour).lines.push_back(place.at(line));
      }
    }
  }
  for (Mark* mark : {&contour, &main, &ticks})
    if (!mark->lines.empty()) drawing.marks.push_back(std::move(*mark));
  for (Mark& mark : letters.marks) drawing.marks.push_back(std::move(mark));
}

void drawCeilings(const Columns& columns, double interval, const Placement& place, Drawing& drawing) {
  Grid heights(columns.widest.width, columns.widest.height, kUnknown);
  float low = 1e9f, high = -1e9f;
  for (size_t i = 0; i < heights.values.size(); ++i) {
    const Stretch* shown = columns.shownAt(i);
    if (shown == nullptr || shown->cut_above) continue;
    heights.values[i] = shown->top;
    low = std::min(low, shown->top), high = std::max(high, shown->top);
  }
  soften(heights, 2);
  Mark steps{"ceiling_step", {}, false, kCeiling, 0.8, {4, 3}, {}};
  const double step = metres(columns.step);
  // Walls are steep as well: a place is a step of the ceiling only if the passage extends on both sides.
  const auto isStep = [&](const Point& p) {
    const Point slope = slopeAt(heights, p, step);
    const double steepness = std::hypot(slope.x, slope.y);
    if (steepness < kCeilingStep) return false;
    for (const double side : {-3.0, 3.0})
      if (!(columns.widest.between({p.x + side * slope.x / steepness, p.y + side * slope.y / steepness}) > 0))
        return false;
    return true;
  };
  const double levels = std::max(2.0, 2 * interval);
  const auto first = static_cast<int>(std::ceil(static_cast<double>(low) / levels)),
             last = static_cast<int>(std::floor(static_cast<double>(high) / levels));
  for (int i = first; i <= last; ++i)
    for (const Line& whole : contours(heights, static_cast<float>(i * levels + 0.02)))
      for (const Line& line : partsOf(smoothed(whole), isStep))
        if (lengthOf(line) * place.scale > 16) steps.lines.push_back(place.at(line));
  if (!steps.lines.empty()) drawing.marks.push_back(std::move(steps));
}

/// Connected components of the columns in `wanted`, each as a list of column indices.
std::vector<std::vector<size_t>> groupsOf(const Grid& grid, const std::vector<bool>& wanted) {
  std::vector<std::vector<size_t>> groups;
  std::vector<bool> seen(wanted.size());
  for (size_t start = 0; start < wanted.size(); ++start) {
    if (!wanted[start] || seen[start]) continue;
    std::vector<size_t> group{start};
    seen[start] = true;
    for (size_t i = 0; i < group.size(); ++i) {
      const int x = static_cast<int>(group[i] % static_cast<size_t>(grid.width)),
                y = static_cast<int>(group[i] / static_cast<size_t>(grid.width));
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (!grid.holds(x + dx, y + dy)) continue;
        const size_t beside = grid.index(x + dx, y + dy);
        if (!wanted[beside] || seen[beside]) continue;
        seen[beside] = true;
        group.push_back(beside);
      }
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace

double drawRelief(const Columns& columns, const MaterialSigns& signs, const Placement& place, Lettered& lettered,
                  Drawing& drawing) {
  Grid heights = heightsIn(columns);
  Grid within = columns.widest;
  std::vector<float> known;
  for (size_t i = 0; i < heights.values.size(); ++i) {
    // Exclude columns under water: the water surface is level, and the floor below it is not drawn.
    if (columns.subject == Subject::hollow && signs.isWater(columns.floor_label[i])) within.values[i] = -1;
    if (!std::isnan(heights.values[i])) known.push_back(heights.values[i]);
  }
  double interval = 0, drawn = 0;
  if (!known.empty()) {
    std::ranges::sort(known);
    const double range = static_cast<double>(known[known.size() * 98 / 100] - known[known.size() * 2 / 100]);
    interval = niceInterval(range);
    soften(heights, 2);
    if (range > interval / 4) {
      drawFloors(columns, std::move(heights), within, interval, place, lettered, drawing);
      drawn = interval;
    }
  }
  if (columns.subject == Subject::hollow) drawCeilings(columns, interval, place, drawing);
  return drawn;
}

size_t drawDripstone(const Columns& columns, const MaterialSigns& signs, const Placement& place, Drawing& drawing) {
  if (columns.subject != Subject::hollow) return 0;
  const size_t count = columns.shown.size();
  const auto width = static_cast<size_t>(columns.widest.width);
  const double square = metres(columns.step) * metres(columns.step);
  Mark standing{"stalagmite", {}, false, kBlack, 1, {}, {}}, hanging{"stalactite", {}, false, kBlack, 1, {}, {}},
      both{"column", {}, false, kBlack, 1, {}, {}}, flow{"flowstone", {}, false, kCeiling, 1.2, {0.1, 3}, {}};
  Lettered taken;
  const auto sign = [&](Point p, bool up, bool down) {
    constexpr double kSize = 5;
    if (!taken.take(p, 2 * kSize + 3, 2 * kSize + 3)) return false;
    Mark& mark = up && down ? both : up ? standing : hanging;
    mark.lines.push_back({{p.x, p.y - (up ? kSize : 0)}, {p.x, p.y + (down ? kSize : 0)}});
    // The symbol of a stalagmite has two strokes that point down (legs); the symbol of a stalactite has two strokes
    // that point up (arms).
    for (const double side : {-0.7, 0.7}) {
      if (up) mark.lines.push_back({{p.x, p.y}, {p.x + side * kSize, p.y + kSize}});
      if (down) mark.lines.push_back({{p.x, p.y}, {p.x + side * kSize, p.y - kSize}});
    }
    return true;
  };
  size_t signs_drawn = 0;
  for (const bool floor : {true, false}) {
    std::vector<bool> wanted(count);
    for (size_t i = 0; i < count; ++i)
      wanted[i] =
          columns.shown[i] != kNone && signs.isDripstone(floor ? columns.floor_label[i] : columns.ceiling_label[i]);
    for (const std::vector<size_t>& group : groupsOf(columns.widest, wanted)) {
      Point middle;
      size_t other = 0;
      for (const size_t i : group) {
        middle.x += static_cast<double>(i % width) / static_cast<double>(group.size());
        middle.y += static_cast<double>(i / width) / static_cast<double>(group.size());
        other += signs.isDripstone(floor ? columns.ceiling_label[i] : columns.floor_label[i]);
      }
      if (floor && static_cast<double>(group.size()) * square > kFlowstone) {
        Grid area(columns.widest.width, columns.widest.height, -1);
        for (const size_t i : group) area.values[i] = 1;
        soften(area, 1);
        for (const Line& line : contours(area, 0)) flow.lines.push_back(place.at(smoothed(line)));
        continue;
      }
      signs_drawn += sign(place.at(middle), floor || 2 * other > group.size(), !floor || 2 * other > group.size());
    }
  }
  for (Mark* mark : {&flow, &standing, &hanging, &both})
    if (!mark->lines.empty()) drawing.marks.push_back(std::move(*mark));
  return signs_drawn;
}

}  // namespace sgm::survey

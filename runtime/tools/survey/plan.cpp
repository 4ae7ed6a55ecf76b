#include "tools/survey/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/render/scene.h"
#include "tools/survey/lettering.h"

namespace sgm::survey {
namespace {

constexpr Ink kHidden{70, 70, 70};
// Pixels: heights of large and small letters, and gap between the label of a floor's height and the circle next to it.
constexpr double kLetters = 8, kSmall = 7, kGap = 5;
// Pixels: minimum distance between two labels that state different heights (kBetweenLabels), and between two labels
// that state the same height (kBetweenLikeLabels).
constexpr double kBetweenLabels = 110, kBetweenLikeLabels = 240;
constexpr size_t kMaxLabels = 24;
// metres; a passage counts as continuing beyond the region if at least this length of the region's border lies in it
constexpr double kLeastLead = 1.5;

/// Approximate distance of each grid point to the nearest wall, in steps, for placing labels.
Grid distancesToWalls(const Grid& widest) {
  Grid distance(widest.width, widest.height, 0);
  const auto from = [&](int x, int y, int dx, int dy, float step) {
    const float there = distance.holds(x + dx, y + dy) ? distance.at(x + dx, y + dy) : 0;
    distance.at(x, y) = std::min(distance.at(x, y), there + step);
  };
  for (int y = 0; y < widest.height; ++y) {
    for (int x = 0; x < widest.width; ++x) {
      if (!(widest.at(x, y) > 0)) continue;
      distance.at(x, y) = 1e6f;
      for (const int dx : {-1, 0, 1}) from(x, y, dx, -1, dx == 0 ? 1.0f : 1.414f);
      from(x, y, -1, 0, 1);
    }
  }
  for (int y = widest.height; y-- > 0;) {
    for (int x = widest.width; x-- > 0;) {
      if (!(widest.at(x, y) > 0)) continue;
      for (const int dx : {-1, 0, 1}) from(x, y, dx, 1, dx == 0 ? 1.0f : 1.414f);
      from(x, y, 1, 0, 1);
    }
  }
  return distance;
}

Grid waterIn(const Columns& columns, const MaterialSigns& signs) {
  Grid water(columns.widest.width, columns.widest.height, -1);
  if (columns.subject != Subject::hollow) return water;
  for (size_t i = 0; i < water.values.size(); ++i)
    if (columns.shown[i] != kNone && signs.isWater(columns.floor_label[i])) water.values[i] = 1;
  soften(water, 1);
  for (size_t i = 0; i < water.values.size(); ++i)
    water.values[i] = std::min(water.values[i], columns.widest.values[i]);
  return water;
}

void drawWater(const Columns& columns, const MaterialSigns& signs, const Placement& place, PlanFigures& figures,
               Drawing& drawing) {
  const Grid water = waterIn(columns, signs);
  Mark area{"water", {}, true, kWater, 1, {}, {}};
  for (const Line& ring : areasAbove(water, 0)) area.lines.push_back(place.at(smoothed(ring)));
  if (area.lines.empty()) return;
  Mark shore{"shore", area.lines, false, kShore, 0.9, {}, {}};
  drawing.marks.push_back(std::move(area));
  drawing.marks.push_back(std::move(shore));
  for (size_t i = 0; i < water.values.size(); ++i) {
    if (const Stretch* shown = columns.shownAt(i); shown != nullptr && signs.isWater(columns.floor_label[i]))
      figures.water.insert(std::round(10 * static_cast<double>(shown->bottom)) / 10);
  }
}

/// Draws the outlines of passages below the shown ones as dashed lines.
void drawUnder(const Columns& columns, const Placement& place, Drawing& drawing) {
  Mark mark{"under", {}, false, kHidden, 0.9, {5, 3}, {}};
  const double least = 4 / metres(columns.step);  // minimum length of an outline, 4 m, in steps
  for (const Line& line : contours(columns.under, 0))
    if (lengthOf(line) > least) mark.lines.push_back(place.at(smoothed(line)));
  if (!mark.lines.empty()) drawing.marks.push_back(std::move(mark));
}

void drawWalls(const Columns& columns, const Placement& place, Drawing& drawing) {
  Mark wall{"wall", {}, false, kBlack, 2.2, {}, {}}, pillar{"pillar", {}, false, kBlack, 1.2, {}, {}};
  for (const Line& line : contours(columns.widest, 0)) {
    const double length = lengthOf(line) * place.scale;
    if (length < 3) continue;
    // Small closed lines are pillars or niches, for which the thick pen of walls is too coarse: use a thinner pen.
    (line.front() == line.back() && length < 60 ? pillar : wall).lines.push_back(place.at(line));
  }
  for (Mark* mark : {&wall, &pillar})
    if (!mark->lines.empty()) drawing.marks.push_back(std::move(*mark));
}

/// Draws a dotted line and a question mark wherever a passage continues beyond the region's border.
void drawLeads(const Columns& columns, const Placement& place, Lettered& lettered, PlanFigures& figures,
               Drawing& drawing) {
  const Grid& widest = columns.widest;
  Mark open{"open", {}, false, kBlack, 0.8, {2, 4}, {}};
  const auto side = [&](int count, const auto& at, Point outward) {
    for (int i = 0; i < count;) {
      const int first = i;
      while (i < count && widest.values[widest.index(static_cast<int>(at(i).x), static_cast<int>(at(i).y))] > 0) ++i;
      if (i == first) {
        ++i;
        continue;
      }
      if ((i - first) * metres(columns.step) < kLeastLead) continue;
      ++figures.leads;
      open.lines.push_back({place.at(at(first)), place.at(at(i - 1))});
      const Point a = place.at(at(first)), b = place.at(at(i - 1));
      const Point middle{(a.x + b.x) / 2 + 10 * outward.x, (a.y + b.y) / 2 + 10 * outward.y};
      // No question marks in an open world, where the ground continues everywhere.
      if (columns.subject == Subject::hollow && lettered.take(middle, 10, 12))
        drawing.marks.push_back(lettering("?", {middle.x, middle.y + kLetters / 2}, kLetters + 1, Align::middle));
    }
  };
  const double right = widest.width - 1, below = widest.height - 1;
  side(widest.width, [&](int i) { return Point{double(i), 0}; }, {0, -1});
  side(widest.width, [&](int i) { return Point{double(i), below}; }, {0, 1});
  side(widest.height, [&](int i) { return Point{0, double(i)}; }, {-1, 0});
  side(widest.height, [&](int i) { return Point{right, double(i)}; }, {1, 0});
  if (!open.lines.empty()) drawing.marks.push_back(std::move(open));
}

/// Draws a number in a circle, on white.
void drawCircled(const std::string& number, Point middle, double radius, Drawing& drawing) {
  Line circle;
  constexpr int kCorners = 24;
  for (int step = 0; step < kCorners; ++step) {
    const double angle = 6.283185307 * step / kCorners;
    circle.push_back({middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)});
  }
  circle.push_back(circle.front());
  drawing.marks.push_back({"room_ground", {circle}, true, kWhite, 1, {}, {}});
  drawing.marks.push_back({"room", {circle}, false, kBlack, 0.8, {}, {}});
  drawing.marks.push_back(lettering(number, {middle.x, middle.y + kSmall / 2}, kSmall, Align::middle));
}

/// Draws letters with a white outline, which interrupts the lines behind them.
void drawOnWhite(Mark letters, Drawing& drawing) {
  Mark ground = letters;
  ground.name = "halo";
  ground.text.clear();
  ground.ink = kWhite;
  ground.width += 4;
  drawing.marks.push_back(std::move(ground));
  drawing.marks.push_back(std::move(letters));
}

/// Writes heights of floors and water surfaces, each with the height of the passage in a circle, where there is room.
void drawHeights(const Columns& columns, const MaterialSigns& signs, const Placement& place, Lettered& lettered,
                 Drawing& drawing) {
  const bool hollow = columns.subject == Subject::hollow;
  const Grid distance = distancesToWalls(columns.widest);
  std::vector<size_t> order;
  for (size_t i = 0; i < distance.values.size(); ++i)
    if (columns.shown[i] != kNone && static_cast<double>(distance.values[i]) * place.scale > 10) order.push_back(i);
  std::ranges::stable_sort(order, std::greater{}, [&](size_t i) { return distance.values[i]; });
  std::vector<std::pair<Point, std::string>> taken;
  for (const size_t i : order) {
    if (taken.size() >= kMaxLabels) return;
    const auto width = static_cast<size_t>(distance.width);
    const Point at = place.at(Point{static_cast<double>(i % width), static_cast<double>(i / width)});
    const Stretch& shown = *columns.shownAt(i);
    if (hollow ? shown.cut_below : shown.cut_above) continue;
    const bool water = hollow && signs.isWater(columns.floor_label[i]);
    const std::string text = wholeMetres(static_cast<double>(hollow ? shown.bottom : shown.top));
    const bool near = std::ranges::any_of(taken, [&](const auto& label) {
      const auto& [place_taken, other] = label;
      return std::hypot(place_taken.x - at.x, place_taken.y - at.y) <
             (other == text ? kBetweenLikeLabels : kBetweenLabels);
    });
    if (near) continue;
    const std::string high = fmt::format("{:.0f}", std::max(1.0f, shown.height()));
    const double wide = letterWidth(text, kLetters), radius = std::max(7.0, letterWidth(high, kSmall) / 2 + 3);
    const double room = 2 * static_cast<double>(distance.values[i]) * place.scale;
    const bool circle = hollow && !shown.cut_above && wide + 2 * radius + kGap < room;
    const double whole = circle ? wide + 2 * radius + kGap : wide;
    if (whole > room || !lettered.take(at, whole + 6, 2 * radius + 4)) continue;
    taken.emplace_back(at, text);
    const double left = at.x - whole / 2;
    drawOnWhite(lettering(text, {left, at.y + kLetters / 2}, kLetters, Align::left, water ? kShore : kBlack), drawing);
    if (circle) drawCircled(high, {left + whole - radius, at.y}, radius, drawing);
  }
}

}  // namespace

std::string wholeMetres(double height) {
  const std::string text = fmt::format("{:.0f}", height);
  return text == "-0" ? "0" : text;
}

MaterialSigns signsFor(const Program& program) {
  MaterialSigns signs;
  for (const std::pmr::string& name : program.materials) {
    signs.water.push_back(name.find("water") != std::pmr::string::npos);
    signs.dripstone.push_back(materialByName(name).pattern == SurfacePattern::flow);
  }
  return signs;
}

Line Placement::at(const Line& line) const {
  Line placed;
  placed.reserve(line.size());
  for (const Point& p : line) placed.push_back(at(p));
  return placed;
}

bool Lettered::take(Point middle, double width, double height) {
  const Room room{{middle.x - width / 2, middle.y - height / 2}, {middle.x + width / 2, middle.y + height / 2}};
  for (const Room& other : rooms_)
    if (room.lo.x < other.hi.x && other.lo.x < room.hi.x && room.lo.y < other.hi.y && other.lo.y < room.hi.y)
      return false;
  rooms_.push_back(room);
  return true;
}

Grid heightsIn(const Columns& columns) {
  Grid heights(columns.widest.width, columns.widest.height, kUnknown);
  for (size_t i = 0; i < heights.values.size(); ++i) {
    const Stretch* shown = columns.shownAt(i);
    if (shown == nullptr) continue;
    const bool hollow = columns.subject == Subject::hollow;
    if (hollow ? shown->cut_below : shown->cut_above) continue;
    heights.values[i] = hollow ? shown->bottom : shown->top;
  }
  return heights;
}

PlanFigures drawPlan(const Columns& columns, const MaterialSigns& signs, const Placement& place, Drawing& drawing) {
  PlanFigures figures;
  const double square = metres(columns.step) * metres(columns.step);
  figures.area = square * squaresAbove(columns.widest);
  figures.empty = figures.area == 0;
  bool any = false;
  for (const float height : heightsIn(columns).values) {
    if (std::isnan(height)) continue;
    const double h = static_cast<double>(height);
    figures.lowest = any ? std::min(figures.lowest, h) : h;
    figures.highest = any ? std::max(figures.highest, h) : h;
    any = true;
  }
  if (columns.subject == Subject::solid) {
    Mark area{"solid", {}, true, kBuilt, 1, {}, {}};
    for (const Line& ring : areasAbove(columns.widest, 0)) area.lines.push_back(place.at(ring));
    if (!area.lines.empty()) drawing.marks.push_back(std::move(area));
  }
  Lettered lettered;
  Drawing letters;  // marks that are painted last, over all lines
  drawWater(columns, signs, place, figures, drawing);
  drawHeights(columns, signs, place, lettered, letters);
  figures.interval = drawRelief(columns, signs, place, lettered, drawing);
  drawUnder(columns, place, drawing);
  figures.dripstones = drawDripstone(columns, signs, place, drawing);
  drawWalls(columns, place, drawing);
  drawLeads(columns, place, lettered, figures, drawing);
  for (Mark& mark : letters.marks) drawing.marks.push_back(std::move(mark));
  return figures;
}

}  // namespace sgm::survey

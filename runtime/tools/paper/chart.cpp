#include "tools/paper/chart.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/utf8.h"

namespace sgm::cli {
namespace {

constexpr double kLineHeight = 18, kGap = 10, kLetter = 6.6;
constexpr double kRoomAMark = 56;  // space for each tick label of the x axis, pixels
constexpr double kOverBar = 5;     // space between a bar and the number above it, pixels
constexpr double kRight = 18;

std::string at(double value) { return fmt::format("{:.2f}", value); }

std::string colour(size_t series) { return fmt::format("s{}", series % kSeriesColours); }

Markup label(double x, double y, std::string_view anchor, std::string_view what) {
  return element("text", {{"x", at(x)}, {"y", at(y)}, {"text-anchor", std::string(anchor)}}, text(what));
}

Markup line(double x0, double y0, double x1, double y1, std::string_view style) {
  return emptyElement("line",
                      {{"x1", at(x0)}, {"y1", at(y0)}, {"x2", at(x1)}, {"y2", at(y1)}, {"class", std::string(style)}});
}

/// The marker of a data point. Its shape depends on the series, because colours may not be distinguishable, for example
/// in print.
Markup pointMark(double x, double y, size_t series) {
  constexpr double kSize = 3.5;
  const std::string style = "mark " + colour(series);
  switch (series % 3) {
    case 0:
      return emptyElement("circle", {{"cx", at(x)}, {"cy", at(y)}, {"r", at(kSize)}, {"class", style}});
    case 1:
      return emptyElement("rect", {{"x", at(x - kSize)},
                                   {"y", at(y - kSize)},
                                   {"width", at(2 * kSize)},
                                   {"height", at(2 * kSize)},
                                   {"class", style}});
    default:
      return emptyElement("path", {{"d", fmt::format("M{:.2f} {:.2f}l{:.2f} {:.2f}h{:.2f}z", x, y - 1.2 * kSize,
                                                     1.2 * kSize, 2.2 * kSize, -2.4 * kSize)},
                                   {"class", style}});
  }
}

/// The layout that line and bar charts share: the legend above the plot area, and tick labels to the left and below.
struct Frame {
  double left = 0, right = 0, top = 0, bottom = 0;  ///< edges of the plot area
  Markup legend;

  double x(double part) const { return left + part * (right - left); }
  double y(double part) const { return bottom - part * (bottom - top); }
};

struct LegendEntry {
  std::string name;
  Series::Style style;
};

Frame frameOf(int width, int height, const std::string& y_title, const Axis& y, std::span<const LegendEntry> entries,
              bool x_title) {
  Frame frame;
  double widest = 0;
  for (const Mark& mark : y.marks()) widest = std::max(widest, textWidth(mark.label));
  frame.left = widest + kGap + 6;
  frame.right = width - kRight;
  frame.bottom = height - kLineHeight - 8 - (x_title ? kLineHeight : 0);
  double cursor_x = 4, cursor_y = 13;
  if (entries.size() > 1) {
    constexpr double kSwatch = 22;
    for (size_t i = 0; i < entries.size(); ++i) {
      const double wide = kSwatch + 6 + textWidth(entries[i].name) + 16;
      if (cursor_x > 4 && cursor_x + wide > width) {
        cursor_x = 4;
        cursor_y += kLineHeight;
      }
      const double middle = cursor_y - 4;
      if (entries[i].style == Series::Style::steps) {
        frame.legend += emptyElement("rect", {{"x", at(cursor_x)},
                                              {"y", at(middle - 5)},
                                              {"width", at(kSwatch)},
                                              {"height", "10"},
                                              {"class", "bar " + colour(i)}});
      } else {
        const bool dashed = entries[i].style == Series::Style::dashed;
        frame.legend += line(cursor_x, middle, cursor_x + kSwatch, middle, (dashed ? "law " : "line ") + colour(i));
        if (!dashed) frame.legend += pointMark(cursor_x + kSwatch / 2, middle, i);
      }
      frame.legend += label(cursor_x + kSwatch + 6, cursor_y, "start", entries[i].name);
      cursor_x += wide;
    }
    cursor_y += kLineHeight + 2;
  }
  if (!y_title.empty()) {
    frame.legend +=
        element("text", {{"x", "4"}, {"y", at(cursor_y)}, {"text-anchor", "start"}, {"class", "axis"}}, text(y_title));
    cursor_y += kLineHeight;
  }
  frame.top = cursor_y - 4;
  return frame;
}

Markup yMarks(const Frame& frame, const Axis& y) {
  Markup out;
  for (const Mark& mark : y.marks()) {
    const double place = frame.y(y.place(mark.value));
    out += line(frame.left, place, frame.right, place, "grid");
    out += label(frame.left - 8, place + 4, "end", mark.label);
  }
  return out;
}

Markup svg(const std::string& title, int width, int height, const Markup& content) {
  return element("svg",
                 {{"xmlns", "http://www.w3.org/2000/svg"},
                  {"viewBox", fmt::format("0 0 {} {}", width, height)},
                  {"style", fmt::format("max-width:{}px", width)},
                  {"role", "img"},
                  {"aria-label", title}},
                 element("title", title) + content) +
         Markup{"\n"};
}

/// The SVG path data of a series. For Style::steps, the path encloses the area below the steps. floor: y coordinate of
/// the lower edge of that area.
std::string pathOf(const std::vector<std::array<double, 2>>& places, Series::Style style, double floor) {
  std::string path;
  for (size_t i = 0; i < places.size(); ++i) {
    const auto [x, y] = places[i];
    if (i == 0) {
      path = style == Series::Style::steps ? fmt::format("M{:.2f} {:.2f}V{:.2f}", x, floor, y)
                                           : fmt::format("M{:.2f} {:.2f}", x, y);
    } else if (style == Series::Style::steps) {
      path += fmt::format("H{:.2f}V{:.2f}", x, y);
    } else {
      path += fmt::format("L{:.2f} {:.2f}", x, y);
    }
  }
  if (style == Series::Style::steps && !places.empty()) path += fmt::format("V{:.2f}", floor);
  return path;
}

}  // namespace

double textWidth(std::string_view text) {
  size_t letters = 0;
  for (size_t i = 0; i < text.size(); i += std::max<size_t>(1, utf8Size(text.substr(i)))) ++letters;
  return kLetter * static_cast<double>(letters);
}

Markup drawn(const LineChart& chart) {
  std::vector<double> xs, ys;
  std::vector<LegendEntry> entries;
  for (const Series& series : chart.series) {
    entries.push_back({series.name, series.style});
    for (const auto& [x, y] : series.points) {
      xs.push_back(x);
      ys.push_back(y);
    }
  }
  const Axis y(chart.y, ys, 6);
  const Frame frame = frameOf(chart.width, chart.height, chart.y.title, y, entries, !chart.x.title.empty());
  const Axis x(chart.x, xs, static_cast<int>((frame.right - frame.left) / kRoomAMark));

  Markup content = frame.legend + yMarks(frame, y);
  for (const Mark& mark : x.marks()) {
    const double place = frame.x(x.place(mark.value));
    content += line(place, frame.bottom, place, frame.bottom + 5, "tick");
    content += label(place, frame.bottom + 18, "middle", mark.label);
  }
  content += line(frame.left, frame.bottom, frame.right, frame.bottom, "base");
  if (!chart.x.title.empty()) {
    content += element("text",
                       {{"x", at((frame.left + frame.right) / 2)},
                        {"y", at(chart.height - 6)},
                        {"text-anchor", "middle"},
                        {"class", "axis"}},
                       text(chart.x.title));
  }
  bool any = false;
  for (size_t i = 0; i < chart.series.size(); ++i) {
    const Series& series = chart.series[i];
    std::vector<std::array<double, 2>> places;
    for (const auto& [at_x, at_y] : series.points)
      if (x.shows(at_x) && y.shows(at_y)) places.push_back({frame.x(x.place(at_x)), frame.y(y.place(at_y))});
    if (places.empty()) continue;
    any = true;
    const std::string_view style = series.style == Series::Style::steps    ? "steps "
                                   : series.style == Series::Style::dashed ? "law "
                                                                           : "line ";
    content += emptyElement(
        "path", {{"d", pathOf(places, series.style, frame.bottom)}, {"class", std::string(style) + colour(i)}});
    if (series.style != Series::Style::line) continue;
    for (const auto& [at_x, at_y] : places) content += pointMark(at_x, at_y, i);
  }
  if (!any) content += label((frame.left + frame.right) / 2, (frame.top + frame.bottom) / 2, "middle", "no data");
  return svg(chart.title, chart.width, chart.height, content);
}

Markup drawn(const BarChart& chart) {
  std::vector<double> values;
  std::vector<LegendEntry> entries;
  for (const BarChart::Bars& bars : chart.series) {
    entries.push_back({bars.name, Series::Style::steps});
    values.insert(values.end(), bars.values.begin(), bars.values.end());
  }
  AxisStyle style = chart.y;
  style.from_zero = true;
  const Axis y(style, values, 6);
  const Frame frame = frameOf(chart.width, chart.height, chart.y.title, y, entries, false);
  Markup content = frame.legend + yMarks(frame, y);
  const double group_width = (frame.right - frame.left) / static_cast<double>(std::max<size_t>(1, chart.groups.size()));
  const double bar_width = 0.76 * group_width / static_cast<double>(std::max<size_t>(1, chart.series.size()));
  for (size_t g = 0; g < chart.groups.size(); ++g) {
    const double begin = frame.left + (static_cast<double>(g) + 0.12) * group_width;
    for (size_t s = 0; s < chart.series.size(); ++s) {
      if (g >= chart.series[s].values.size() || !y.shows(chart.series[s].values[g])) continue;
      const double value = chart.series[s].values[g];
      const double top = frame.y(y.place(value)), x = begin + static_cast<double>(s) * bar_width;
      content += emptyElement("rect", {{"x", at(x)},
                                       {"y", at(top)},
                                       {"width", at(0.94 * bar_width)},
                                       {"height", at(frame.bottom - top)},
                                       {"class", "bar " + colour(s)}});
      // Omit the number if it is wider than the bar, since it could overlap its neighbours.
      const std::string number = shortNumber(value, 3);
      if (textWidth(number) > bar_width) continue;
      const bool above = top - kOverBar > frame.top;
      content += element("text",
                         {{"x", at(x + 0.47 * bar_width)},
                          {"y", at(above ? top - kOverBar : top + 15)},
                          {"text-anchor", "middle"},
                          {"class", above ? "" : "in"}},
                         text(number));
    }
    content += label(begin + 0.38 * group_width, frame.bottom + 18, "middle", chart.groups[g]);
  }
  content += line(frame.left, frame.bottom, frame.right, frame.bottom, "base");
  return svg(chart.title, chart.width, chart.height, content);
}

}  // namespace sgm::cli

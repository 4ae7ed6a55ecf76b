#pragma once
// Charts as inline SVG, with the colours and fonts of the surrounding page (report_style.h).

#include <array>
#include <string>
#include <vector>

#include "tools/paper/axis.h"
#include "tools/paper/html.h"

namespace sgm::cli {

/// Number of series colours of a page; further series repeat them.
inline constexpr size_t kSeriesColours = 6;

struct Series {
  enum class Style {
    line,    ///< with a mark at each point
    dashed,  ///< without marks: a claim, or a law
    steps,   ///< a filled histogram: each value holds until the next point
  };
  std::string name;
  std::vector<std::array<double, 2>> points;  ///< points that the axes cannot show are omitted
  Style style = Style::line;
};

struct LineChart {
  std::string title;  ///< description for readers who cannot see the chart
  AxisStyle x, y;
  std::vector<Series> series;
  int width = 640, height = 360;  ///< of the view, which the page scales. At least 200 by 150
};
Markup drawn(const LineChart& chart);

/// Grouped bars: one bar of each series in each group.
struct BarChart {
  struct Bars {
    std::string name;
    std::vector<double> values;  ///< one for each group, at least 0; non-finite ones have no bar
  };
  std::string title;
  AxisStyle y;
  std::vector<std::string> groups;
  std::vector<Bars> series;
  int width = 640, height = 320;
};
Markup drawn(const BarChart& chart);

/// Approximate width of a text in a chart, in units of its view.
double textWidth(std::string_view text);

}  // namespace sgm::cli

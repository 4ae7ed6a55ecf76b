#pragma once
// Makes charts as inline SVG, in the colours and fonts of the surrounding page (report_style.h).

#include <array>
#include <string>
#include <vector>

#include "tools/paper/axis.h"
#include "tools/paper/html.h"

namespace sgm::cli {

/// Number of series colours in the style sheet of the page; further series repeat the colours.
inline constexpr size_t kSeriesColours = 6;

struct Series {
  enum class Style {
    line,    ///< a line with a marker at each point
    dashed,  ///< a dashed line without markers, for theoretical laws and claims of the paper
    steps,   ///< a filled histogram: each value holds until the next point
  };
  std::string name;
  std::vector<std::array<double, 2>> points;  ///< points (x, y); points that the axes cannot show are not drawn
  Style style = Style::line;
};

struct LineChart {
  std::string title;  ///< text alternative for readers who cannot see the chart
  AxisStyle x, y;
  std::vector<Series> series;
  int width = 640, height = 360;  ///< size of the SVG's view box, at least 200 by 150; the page scales it
};
Markup drawn(const LineChart& chart);

/// A chart of grouped bars: each group has one bar per series.
struct BarChart {
  struct Bars {
    std::string name;
    std::vector<double> values;  ///< one value for each group, at least 0; non-finite values have no bar
  };
  std::string title;
  AxisStyle y;
  std::vector<std::string> groups;
  std::vector<Bars> series;
  int width = 640, height = 320;
};
Markup drawn(const BarChart& chart);

/// Approximate width of a text in a chart, in units of the SVG's view box.
double textWidth(std::string_view text);

}  // namespace sgm::cli

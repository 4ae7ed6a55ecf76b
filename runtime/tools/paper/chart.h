#pragma once
// Charts as inline SVG, whose colours and fonts are those of the page around them (report_style.h).

#include <array>
#include <string>
#include <vector>

#include "tools/paper/axis.h"
#include "tools/paper/html.h"

namespace sgm::cli {

/// Colours that a page has for series; further ones begin anew.
inline constexpr size_t kSeriesColours = 6;

struct Series {
  enum class Style {
    line,    ///< with a mark at each point
    dashed,  ///< without marks: what is claimed, or a law
    steps,   ///< from one point to the next at the height of the first, filled: a histogram
  };
  std::string name;
  std::vector<std::array<double, 2>> points;  ///< those that the axes cannot show are left out
  Style style = Style::line;
};

struct LineChart {
  std::string title;  ///< what is to be seen, for who cannot see it too
  AxisStyle x, y;
  std::vector<Series> series;
  int width = 640, height = 360;  ///< of the view; the page scales it. At least 200 by 150
};
Markup drawn(const LineChart& chart);

/// Bars side by side: one of each series in each group.
struct BarChart {
  struct Bars {
    std::string name;
    std::vector<double> values;  ///< one a group, from 0 up; what is not finite has no bar
  };
  std::string title;
  AxisStyle y;
  std::vector<std::string> groups;
  std::vector<Bars> series;
  int width = 640, height = 320;
};
Markup drawn(const BarChart& chart);

/// About how wide a text of a chart is, in units of its view.
double textWidth(std::string_view text);

}  // namespace sgm::cli

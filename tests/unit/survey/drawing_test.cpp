#include "catch.h"
#include "tools/survey/lettering.h"
#include "tools/survey/raster.h"
#include "tools/survey/svg.h"

using namespace sgm;
using namespace sgm::survey;

namespace {

int redAt(const Image& image, int x, int y) {
  return image.rgba[4 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x))];
}

}  // namespace

TEST_CASE("areas and lines cover the pixels that they lie on", "[survey]") {
  Drawing drawing{20, 20, {}};
  const Line outer{{2, 2}, {18, 2}, {18, 18}, {2, 18}}, hole{{8, 8}, {12, 8}, {12, 12}, {8, 12}};
  drawing.marks.push_back({"area", {outer, hole}, true, kBlack, 1, {}, {}});
  Image image = rasterise(drawing);
  CHECK(redAt(image, 0, 0) == 255);
  CHECK(redAt(image, 5, 5) == 0);
  CHECK(redAt(image, 10, 10) == 255);
  drawing.marks = {{"line", {{{-5, 10}, {30, 10}}}, false, kBlack, 2, {}, {}}};
  image = rasterise(drawing);
  CHECK(redAt(image, 10, 9) == 0);
  CHECK(redAt(image, 10, 10) == 0);
  CHECK(redAt(image, 10, 12) == 255);
  // A line that is one pixel wide and lies on the border of two rows covers half of the pixels in each row.
  drawing.marks = {{"line", {{{0, 10}, {20, 10}}}, false, kBlack, 1, {}, {}}};
  image = rasterise(drawing);
  CHECK(redAt(image, 10, 9) == Approx(128).margin(1));
}

TEST_CASE("dashes go on over corners", "[survey]") {
  const std::vector<Line> parts = dashed({{0, 0}, {5, 0}, {5, 5}}, {4, 2});
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].back() == Point{4, 0});
  CHECK(parts[1].front() == Point{5, 1});
  CHECK(dashed({{0, 0}, {5, 0}}, {}).size() == 1);
}

TEST_CASE("letters stand on their baseline, as wide as was said", "[survey]") {
  for (char c = 33; c < 127; ++c) CHECK_FALSE(lettering(std::string(1, c), {0, 0}, 10).lines.empty());
  const Mark mark = lettering("H-3.5 m", {100, 50}, 21, Align::right);
  double left = 1e9, right = -1e9;
  for (const Line& line : mark.lines) {
    for (const Point& p : line) {
      left = std::min(left, p.x), right = std::max(right, p.x);
      CHECK(p.y >= 50 - 21.5);
      CHECK(p.y <= 50.5);
    }
  }
  CHECK(right <= 100);
  CHECK(left >= 100 - letterWidth("H-3.5 m", 21));
  // A character of several bytes is drawn as one glyph.
  CHECK(letterWidth("\xC3\xA4", 21) == letterWidth("?", 21));
}

TEST_CASE("SVG says what lines are, and texts in words", "[survey]") {
  Drawing drawing{30, 20, {}};
  drawing.marks.push_back({"wall", {{{1, 2}, {3.256, 4}, {5, 6}}}, false, kBlack, 2.2, {4, 3}, {}});
  drawing.marks.push_back({"water", {{{0, 0}, {9, 0}, {9, 9}}}, true, {1, 2, 255}, 1, {}, {}});
  drawing.marks.push_back(lettering("a < b & \"c\"", {5, 5}, 8));
  const std::string svg = svgText(drawing, "x & y");
  const auto has = [&](std::string_view part) { return svg.find(part) != std::string::npos; };
  CHECK(has("<title>x &amp; y</title>"));
  CHECK(
      has("<path class=\"wall\" stroke=\"#000000\" stroke-width=\"2.2\" stroke-dasharray=\"4 3\" "
          "d=\"M1 2L3.26 4 5 6\"/>"));
  CHECK(has("<path class=\"water\" fill=\"#0102ff\" fill-rule=\"evenodd\" d=\"M0 0L9 0 9 9Z\"/>"));
  CHECK(has("aria-label=\"a &lt; b &amp; &quot;c&quot;\""));
  CHECK(svg.ends_with("</svg>\n"));
}

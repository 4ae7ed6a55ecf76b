// Tests HTML and charts of the report: well-formed, inside their frames and legible, for any input.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "catch.h"
#include "rounds.h"
#include "tools/paper/chart.h"

using namespace sgm::cli;
using sgm::rounds;

namespace {

/// The text that a reader of HTML obtains from escaped text.
std::string unescaped(const std::string& html) {
  constexpr std::pair<const char*, char> kNames[] = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}};
  std::string out;
  for (size_t i = 0; i < html.size();) {
    const auto name = std::ranges::find_if(
        kNames, [&](const auto& n) { return html.compare(i, std::strlen(n.first), n.first) == 0; });
    if (name == std::end(kNames)) {
      out += html[i++];
    } else {
      out += name->second;
      i += std::strlen(name->first);
    }
  }
  return out;
}

/// Checks that every element is closed in order, and that text contains no HTML markup. Returns the texts between
/// elements.
std::vector<std::string> textsOf(const std::string& html) {
  std::vector<std::string> open, texts;
  for (size_t i = 0; i < html.size();) {
    if (html[i] != '<') {
      const size_t end = std::min(html.find('<', i), html.size());
      texts.push_back(html.substr(i, end - i));
      REQUIRE(texts.back().find('>') == std::string::npos);
      i = end;
      continue;
    }
    size_t end = i;
    for (bool quoted = false; quoted || html[end] != '>'; ++end) {
      REQUIRE(end + 1 < html.size());
      if (html[end] == '"') quoted = !quoted;
      if (end > i) REQUIRE(html[end] != '<');
    }
    const std::string tag = html.substr(i + 1, end - i - 1);
    const std::string name = tag.substr(0, tag.find(' '));
    if (name[0] == '/') {
      REQUIRE(!open.empty());
      REQUIRE(open.back() == name.substr(1));
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    i = end + 1;
  }
  REQUIRE(open.empty());
  return texts;
}

/// All values of one attribute, in their order.
std::vector<double> valuesOf(const std::string& html, const std::string& attribute) {
  std::vector<double> values;
  const std::string begin = " " + attribute + "=\"";
  for (size_t i = html.find(begin); i != std::string::npos; i = html.find(begin, i + 1))
    values.push_back(std::stod(html.substr(i + begin.size())));
  return values;
}

double anyNumber(std::mt19937_64& random) {
  std::uniform_int_distribution<int> kind(0, 19);
  std::uniform_real_distribution<double> unit(-1, 1);
  switch (kind(random)) {
    case 0:
      return std::numeric_limits<double>::quiet_NaN();
    case 1:
      return -std::numeric_limits<double>::infinity();
    case 2:
      return std::numeric_limits<double>::max();
    case 3:
      return 0;
    case 4:
      return std::numeric_limits<double>::denorm_min();
    default:
      return unit(random) * std::pow(10, 12 * unit(random));
  }
}

std::string anyText(std::mt19937_64& random) {
  std::uniform_int_distribution<int> length(0, 24), byte(0, 255), kind(0, 3);
  constexpr std::string_view kMarks = "<>&\"'/=";
  std::string text;
  for (int i = length(random); i > 0; --i) {
    if (kind(random) == 0) {
      text += kMarks[static_cast<size_t>(byte(random)) % kMarks.size()];
    } else {
      text += static_cast<char>(byte(random));
    }
  }
  return text;
}

bool inside(const std::vector<double>& values, double low, double high) {
  return std::ranges::all_of(values, [&](double v) { return v >= low && v <= high; });
}

}  // namespace

TEST_CASE("escaped text is what it was, without any mark of HTML") {
  std::mt19937_64 random(7);
  for (unsigned i = 0; i < rounds(2000); ++i) {
    CAPTURE(i);
    std::string plain;
    std::uniform_int_distribution<int> letter(0x20, 0x7E);
    for (int n = 0; n < 20; ++n) plain += static_cast<char>(letter(random));
    const std::string html = escaped(plain);
    CHECK(html.find_first_of("<>\"'") == std::string::npos);
    CHECK(unescaped(html) == plain);
  }
  CHECK(escaped("a\x01\xFF\xC0\x80z") == "a\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBDz");
  CHECK(escaped("m³ – ∞") == "m³ – ∞");
  CHECK(escaped("\xEF\xBF\xBF") == "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // U+FFFF is not allowed in XML
}

TEST_CASE("elements are well formed, whatever their texts and values") {
  std::mt19937_64 random(7);
  for (unsigned i = 0; i < rounds(500); ++i) {
    CAPTURE(i);
    const std::string inner = anyText(random), value = anyText(random);
    const Markup made = element("p", {{"title", value}}, text(inner) + emptyElement("br", {}) + element("b", value));
    textsOf(made.html);
    textsOf(table(inner, std::vector<std::vector<std::string>>{{"a", inner}, {value, "b"}}).html);
  }
}

TEST_CASE("marks of an axis rise, lie inside it, are no more than fit, and have labels of their own") {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<int> count(0, 12), most(2, 12), flag(0, 1);
  for (unsigned i = 0; i < rounds(3000); ++i) {
    AxisStyle style;
    style.logarithmic = flag(random) == 1;
    style.from_zero = flag(random) == 1;
    std::vector<double> values;
    for (int n = count(random); n > 0; --n) values.push_back(anyNumber(random));
    const int fits = most(random);
    CAPTURE(values, fits, style.logarithmic, style.from_zero);
    const Axis axis(style, values, fits);
    const std::vector<Mark>& marks = axis.marks();
    REQUIRE(marks.size() >= 2);
    CHECK(marks.size() <= static_cast<size_t>(std::max(fits + 1, 9)));
    for (size_t m = 0; m < marks.size(); ++m) {
      CHECK(axis.shows(marks[m].value));
      CHECK(!marks[m].label.empty());
      if (m == 0) continue;
      CHECK(marks[m].value > marks[m - 1].value);
      CHECK(marks[m].label != marks[m - 1].label);
      CHECK(axis.place(marks[m].value) > axis.place(marks[m - 1].value));
    }
    for (const double value : values) {
      if (!axis.shows(value)) continue;
      CHECK(axis.place(value) >= 0);
      CHECK(axis.place(value) <= 1);
    }
  }
}

TEST_CASE("numbers are short and keep their digits") {
  CHECK(shortNumber(0) == "0");
  CHECK(shortNumber(-0.0) == "0");
  CHECK(shortNumber(1234567) == "1234567");
  CHECK(shortNumber(0.125) == "0.125");
  CHECK(shortNumber(0.0123456) == "0.01235");
  CHECK(shortNumber(3.14159, 3) == "3.14");
  CHECK(shortNumber(-42.5) == "-42.5");
  CHECK(shortNumber(1e-7) == "1e-07");
  CHECK(shortNumber(std::numeric_limits<double>::infinity()) == "-");
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> power(-8, 9);
  for (unsigned i = 0; i < rounds(2000); ++i) {
    CAPTURE(i);
    const double value = std::pow(10, power(random));
    CHECK(std::abs(std::stod(shortNumber(value, 6)) / value - 1) < 1e-5);
  }
}

TEST_CASE("charts are well formed and inside their view, whatever is drawn") {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<int> count(0, 8), flag(0, 1), style(0, 2), width(200, 900), height(150, 500);
  for (unsigned i = 0; i < rounds(400); ++i) {
    CAPTURE(i);
    LineChart chart;
    chart.title = anyText(random);
    chart.width = width(random);
    chart.height = height(random);
    chart.x = {anyText(random), flag(random) == 1, flag(random) == 1, {}, {}};
    chart.y = {"y", flag(random) == 1, flag(random) == 1, {}, {}};
    for (int s = count(random) / 3; s > 0; --s) {
      Series& series = chart.series.emplace_back();
      series.name = "series";
      series.style = static_cast<Series::Style>(style(random));
      for (int n = count(random); n > 0; --n) series.points.push_back({anyNumber(random), anyNumber(random)});
    }
    const std::string html = drawn(chart).html;
    textsOf(html);
    CHECK(html.find("nan") == std::string::npos);
    CHECK(html.find("inf\"") == std::string::npos);
    for (const char* x : {"x", "x1", "x2", "cx"}) CHECK(inside(valuesOf(html, x), -1, chart.width + 1));
    for (const char* y : {"y", "y1", "y2", "cy"}) CHECK(inside(valuesOf(html, y), -20, chart.height + 1));
  }
}

TEST_CASE("what is drawn stands where its values are") {
  LineChart chart;
  chart.title = "a line";
  chart.series = {{"rise", {{0, 0}, {1, 1}, {2, 4}}, Series::Style::line}};
  const std::string html = drawn(chart).html;
  const std::vector<double> x = valuesOf(html, "cx"), y = valuesOf(html, "cy");
  REQUIRE(x.size() == 3);
  CHECK(std::abs((x[1] - x[0]) - (x[2] - x[1])) < 0.1);
  CHECK(std::abs(3 * (y[0] - y[1]) - (y[1] - y[2])) < 0.1);

  BarChart bars;
  bars.title = "bars";
  bars.groups = {"one", "two"};
  bars.series = {{"a", {1, 3}}, {"b", {2, std::numeric_limits<double>::quiet_NaN()}}};
  const std::vector<double> heights = valuesOf(drawn(bars).html, "height");
  REQUIRE(heights.size() == 2 + 3);  // two marks of the legend, and a bar for each value that is a number
  CHECK(std::abs(heights[2] * 2 - heights[3]) < 0.1);
  CHECK(std::abs(heights[2] * 3 - heights[4]) < 0.1);
}

TEST_CASE("every bar that is wide enough has its number, also one as high as its frame") {
  for (double value = 30.25; value < 51; value += 0.5) {
    CAPTURE(value);
    BarChart bars;
    bars.groups = {"one", "two"};
    bars.series = {{"a", {value, 12.25}}};
    const std::string html = drawn(bars).html;
    const std::vector<std::string> texts = textsOf(html);
    CHECK(std::ranges::count(texts, shortNumber(value, 3)) == 1);
    CHECK(std::ranges::count(texts, shortNumber(12.25, 3)) == 1);
  }
}

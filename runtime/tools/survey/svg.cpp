#include "tools/survey/svg.h"

#include <fmt/core.h>

namespace sgm::survey {
namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      out += c;
  }
  return out;
}

/// A number as text, rounded to hundredths (of a pixel), without trailing zeros.
std::string number(double value) {
  std::string text = fmt::format("{:.2f}", value);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string colour(Ink ink) { return fmt::format("#{:02x}{:02x}{:02x}", ink.r, ink.g, ink.b); }

std::string pathData(const Mark& mark) {
  std::string data;
  for (const Line& line : mark.lines) {
    if (line.empty()) continue;
    for (size_t i = 0; i < line.size(); ++i) {
      data += i == 0 ? 'M' : i == 1 ? 'L' : ' ';
      data += number(line[i].x) + ' ' + number(line[i].y);
    }
    const bool closed = line.size() > 2 && line.front() == line.back();
    if (mark.filled || closed) data += 'Z';
    if (line.size() == 1) data += "h0";
  }
  return data;
}

std::string element(const Mark& mark) {
  std::string attributes = fmt::format("class=\"{}\"", mark.name);
  if (!mark.text.empty()) attributes += fmt::format(" role=\"img\" aria-label=\"{}\"", escaped(mark.text));
  if (mark.filled) {
    attributes += fmt::format(" fill=\"{}\" fill-rule=\"evenodd\"", colour(mark.ink));
  } else {
    attributes += fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", colour(mark.ink), number(mark.width));
    for (size_t i = 0; i < mark.dashes.size(); ++i)
      attributes += (i == 0 ? " stroke-dasharray=\"" : " ") + number(mark.dashes[i]);
    if (!mark.dashes.empty()) attributes += '"';
  }
  return fmt::format("<path {} d=\"{}\"/>\n", attributes, pathData(mark));
}

}  // namespace

std::string svgText(const Drawing& drawing, std::string_view title) {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n"
      "<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
      drawing.width, drawing.height, escaped(title));
  for (const Mark& mark : drawing.marks) text += element(mark);
  return text + "</g>\n</svg>\n";
}

}  // namespace sgm::survey

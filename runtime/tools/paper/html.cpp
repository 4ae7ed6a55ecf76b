#include "tools/paper/html.h"

#include "base/utf8.h"

namespace sgm::cli {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// Number of bytes of the first character of `text`; 0 if the character is not valid UTF-8, or is not allowed in XML.
size_t characterAt(std::string_view text) {
  const size_t bytes = utf8Size(text);
  const bool control = bytes == 1 && static_cast<unsigned char>(text[0]) < 0x20 && text[0] != '\n' && text[0] != '\t';
  const bool nothing = text.starts_with("\xEF\xBF\xBE") || text.starts_with("\xEF\xBF\xBF");
  return control || nothing ? 0 : bytes;
}

std::string opening(std::string_view tag, const Attributes& attributes) {
  std::string out = "<" + std::string(tag);
  for (const auto& [name, value] : attributes) out.append(" ").append(name).append("=\"" + escaped(value) + "\"");
  return out;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const size_t length = characterAt(text);
    const std::string_view character = text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
    if (character == "&") {
      out += "&amp;";
    } else if (character == "<") {
      out += "&lt;";
    } else if (character == ">") {
      out += "&gt;";
    } else if (character == "\"") {
      out += "&quot;";
    } else if (character == "'") {
      out += "&#39;";
    } else {
      out += length == 0 ? kReplacement : character;
    }
  }
  return out;
}

Markup text(std::string_view plain) { return {escaped(plain)}; }

Markup element(std::string_view tag, const Attributes& attributes, const Markup& content) {
  return {opening(tag, attributes) + ">" + content.html + "</" + std::string(tag) + ">"};
}

Markup emptyElement(std::string_view tag, const Attributes& attributes) { return {opening(tag, attributes) + "/>"}; }

Markup table(std::string_view caption, const std::vector<std::vector<Markup>>& rows) {
  Markup head, body;
  for (size_t r = 0; r < rows.size(); ++r) {
    Markup cells;
    for (size_t c = 0; c < rows[r].size(); ++c) {
      if (r == 0) {
        cells += element("th", {{"scope", "col"}}, rows[r][c]);
      } else if (c == 0) {
        cells += element("th", {{"scope", "row"}}, rows[r][c]);
      } else {
        cells += element("td", rows[r][c]);
      }
    }
    (r == 0 ? head : body) += element("tr", cells) + Markup{"\n"};
  }
  return element("div", {{"class", "table"}},
                 element("table", element("caption", caption) + element("thead", head) + element("tbody", body))) +
         Markup{"\n"};
}

Markup table(std::string_view caption, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::vector<Markup>> cells;
  for (const std::vector<std::string>& row : rows) {
    std::vector<Markup>& made = cells.emplace_back();
    for (const std::string& cell : row) made.push_back(text(cell));
  }
  return table(caption, cells);
}

}  // namespace sgm::cli

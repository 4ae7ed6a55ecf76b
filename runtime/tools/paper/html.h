#pragma once
// Builds HTML that is well-formed by construction: text is escaped, and every opened element is closed. The result is
// also well-formed XML, so that any XML parser can read it.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sgm::cli {

/// Escapes text for use as element content and in quoted attributes. Invalid UTF-8, and characters that XML forbids,
/// become U+FFFD.
std::string escaped(std::string_view text);

/// A piece of HTML: a sequence of complete elements and escaped text.
struct Markup {
  std::string html;

  Markup& operator+=(const Markup& more) {
    html += more.html;
    return *this;
  }
  friend Markup operator+(Markup a, const Markup& b) { return std::move(a += b); }
};

/// Names and values of attributes. Names are not escaped and must be valid; values are escaped.
using Attributes = std::vector<std::pair<std::string_view, std::string>>;

Markup text(std::string_view plain);
Markup element(std::string_view tag, const Attributes& attributes, const Markup& content);
inline Markup element(std::string_view tag, const Markup& content) { return element(tag, {}, content); }
inline Markup element(std::string_view tag, std::string_view plain) { return element(tag, {}, text(plain)); }
inline Markup element(std::string_view tag, const char* plain) { return element(tag, std::string_view(plain)); }
/// Makes an element without content, such as img, rect or path.
Markup emptyElement(std::string_view tag, const Attributes& attributes);

/// Makes a table. The first row is the head; the first cell of each other row is its row header.
Markup table(std::string_view caption, const std::vector<std::vector<Markup>>& rows);
/// Makes a table from plain text, with the same head and row headers as the overload for Markup.
Markup table(std::string_view caption, const std::vector<std::vector<std::string>>& rows);

}  // namespace sgm::cli

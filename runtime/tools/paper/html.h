#pragma once
// Builds HTML that is well-formed by construction: text is escaped, and each opened element is closed. The result is
// also well-formed XML, so that any parser can read it.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sgm::cli {

/// Escapes text for content and quoted attributes. Invalid UTF-8, and characters that XML forbids, become U+FFFD.
std::string escaped(std::string_view text);

/// A sequence of whole elements and escaped text.
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
/// An element that never has content: img, rect, path.
Markup emptyElement(std::string_view tag, const Attributes& attributes);

/// A table; its first row is the head, and the first cell of each other row is that row's header.
Markup table(std::string_view caption, const std::vector<std::vector<Markup>>& rows);
/// A table whose cells are plain text, otherwise as above.
Markup table(std::string_view caption, const std::vector<std::vector<std::string>>& rows);

}  // namespace sgm::cli

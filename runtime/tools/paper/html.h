#pragma once
// HTML that is well-formed by construction: text is escaped, and each opened element is closed. It is also well-formed
// XML, so that any parser can read it.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sgm::cli {

/// Escapes text for content and quoted attributes. Invalid UTF-8, and characters that XML forbids, become U+FFFD.
std::string escaped(std::string_view text);

/// Whole elements and escaped text, one after another.
struct Markup {
  std::string html;

  Markup& operator+=(const Markup& more) {
    html += more.html;
    return *this;
  }
  friend Markup operator+(Markup a, const Markup& b) { return std::move(a += b); }
};

/// Names come from the caller and are not escaped; values are.
using Attributes = std::vector<std::pair<std::string_view, std::string>>;

Markup text(std::string_view plain);
Markup element(std::string_view tag, const Attributes& attributes, const Markup& content);
inline Markup element(std::string_view tag, const Markup& content) { return element(tag, {}, content); }
inline Markup element(std::string_view tag, std::string_view plain) { return element(tag, {}, text(plain)); }
inline Markup element(std::string_view tag, const char* plain) { return element(tag, std::string_view(plain)); }
/// An element without content: img, rect, path.
Markup emptyElement(std::string_view tag, const Attributes& attributes);

/// A table; the first row is its head, and the first cell of each other row names it.
Markup table(std::string_view caption, const std::vector<std::vector<Markup>>& rows);
/// The same with plain text.
Markup table(std::string_view caption, const std::vector<std::vector<std::string>>& rows);

}  // namespace sgm::cli

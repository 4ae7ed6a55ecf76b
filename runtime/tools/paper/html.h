#pragma once
// HTML that is well formed because nothing else can be written: text is escaped, and what is opened is closed. It is
// well-formed XML as well, so that any parser reads it.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sgm::cli {

/// Text with its meaning for HTML taken out, for content and for attributes in quotes. What is not UTF-8, or no
/// character of XML, becomes U+FFFD.
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

/// Names are the caller's and are not escaped; values are.
using Attributes = std::vector<std::pair<std::string_view, std::string>>;

Markup text(std::string_view plain);
Markup element(std::string_view tag, const Attributes& attributes, const Markup& content);
inline Markup element(std::string_view tag, const Markup& content) { return element(tag, {}, content); }
inline Markup element(std::string_view tag, std::string_view plain) { return element(tag, {}, text(plain)); }
inline Markup element(std::string_view tag, const char* plain) { return element(tag, std::string_view(plain)); }
/// One that has no content: img, rect, path.
Markup emptyElement(std::string_view tag, const Attributes& attributes);

/// A table; the first row is its head, the first cell of the others names them.
Markup table(std::string_view caption, const std::vector<std::vector<Markup>>& rows);
/// Likewise of plain text.
Markup table(std::string_view caption, const std::vector<std::vector<std::string>>& rows);

}  // namespace sgm::cli

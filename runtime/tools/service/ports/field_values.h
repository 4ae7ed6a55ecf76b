#pragma once
// Parses the values of HTTP request fields.

#include <string>
#include <string_view>
#include <vector>

namespace sgm::service {

/// The text with ASCII letters in lower case; other characters are unchanged.
std::string inSmallLetters(std::string_view text);
/// The media type of a Content-Type value, in lower case and without parameters: "model/stl".
std::string mediaType(std::string_view content_type);
/// The members of a comma-separated list, without surrounding spaces. Commas within quoted strings do not separate.
std::vector<std::string_view> listed(std::string_view value);
/// Whether the value of If-None-Match contains this entity tag, by weak comparison (RFC 9110, 8.8.3.2 and 13.1.2).
bool namesTag(std::string_view if_none_match, std::string_view tag);

}  // namespace sgm::service

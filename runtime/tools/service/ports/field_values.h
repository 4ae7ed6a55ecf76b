#pragma once
// Parses the values of HTTP request headers.

#include <string>
#include <string_view>
#include <vector>

namespace sgm::service {

/// Converts ASCII letters to lower case, and leaves other characters unchanged.
std::string inSmallLetters(std::string_view text);
/// The media type in the value of Content-Type, such as "model/stl": in lower case and without parameters.
std::string mediaType(std::string_view content_type);
/// The elements of a comma-separated list, without surrounding spaces. Commas in quoted strings do not separate
/// elements.
std::vector<std::string_view> listed(std::string_view value);
/// Whether the value of If-None-Match contains this ETag, by weak comparison (RFC 9110, 8.8.3.2 and 13.1.2).
bool namesTag(std::string_view if_none_match, std::string_view tag);

}  // namespace sgm::service

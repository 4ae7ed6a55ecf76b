#pragma once
// Parses values of request fields.

#include <string>
#include <string_view>
#include <vector>

namespace sgm::service {

/// Only ASCII letters, as in names of HTTP.
std::string inSmallLetters(std::string_view text);
/// The media type of a Content-Type in lower case, without parameters: "model/stl".
std::string mediaType(std::string_view content_type);
/// The members of a list, trimmed; quoted strings are not split.
std::vector<std::string_view> listed(std::string_view value);
/// Whether an If-None-Match matches this entity tag, by weak comparison (RFC 9110, 8.8.3.2 and 13.1.2).
bool namesTag(std::string_view if_none_match, std::string_view tag);

}  // namespace sgm::service

#pragma once
// What stands in fields of requests.

#include <string>
#include <string_view>
#include <vector>

namespace sgm::service {

/// ASCII letters alone: names in HTTP have no others.
std::string inSmallLetters(std::string_view text);
/// The type of a Content-Type in small letters, without its parameters: "model/stl".
std::string mediaType(std::string_view content_type);
/// The members of a list, trimmed; what stands in quotes is not cut.
std::vector<std::string_view> listed(std::string_view value);
/// Whether an If-None-Match names this entity tag, by weak comparison (RFC 9110, 8.8.3.2 and 13.1.2).
bool namesTag(std::string_view if_none_match, std::string_view tag);

}  // namespace sgm::service

#pragma once
// Parses and decodes the target of a request line (path and query).

#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

/// Maximum number of query parameters.
constexpr size_t kMaxParameters = 64;

/// Sets request.path and request.query. Returns a 400 for ambiguous targets:
/// - a path with empty segments ("//"), "." or "..", or an encoded '/' or '\';
/// - invalid escapes, control characters, or invalid UTF-8 after decoding;
/// - the forms `*` and `host:port`, a fragment, or a URL with a scheme other than http, a user name, or a host other
///   than that in the header Host.
/// In the query, '+' stands for a space, as in HTML forms; a parameter without '=' has an empty value.
std::optional<Problem> readTarget(std::string_view target, std::optional<std::string_view> host, Request& request);

}  // namespace sgm::service::http

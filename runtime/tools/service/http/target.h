#pragma once
// Parses and decodes the target of a request line (path and query).

#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

/// The maximal number of query parameters.
constexpr size_t kMaxParameters = 64;

/// Sets request.path and request.query. A 400 rejects ambiguous targets:
/// - a path with empty segments ("//"), "." or "..", an encoded '/' or '\', in any encoding;
/// - invalid escapes, control characters, and invalid UTF-8 after decoding;
/// - the forms `*` and `host:port`, a fragment, and a URL with a scheme other than http, a user's name, or a host other
/// than that of the field Host.
/// In the query '+' is a space, as in HTML forms; parameters without '=' have an empty value.
std::optional<Problem> readTarget(std::string_view target, std::optional<std::string_view> host, Request& request);

}  // namespace sgm::service::http

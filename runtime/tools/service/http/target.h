#pragma once
// A request line's target, taken apart and decoded.

#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

/// How many parameters a query may have.
constexpr size_t kMostParameters = 64;

/// Writes request.path and request.query. Refused, with 400, so that what was checked is what is meant:
/// - a path with empty segments ("//"), "." or "..", an encoded '/' or '\', however they were encoded;
/// - escapes that are none, control characters, and what is not UTF-8 once decoded;
/// - the forms `*` and `host:port`, a fragment, and a whole URL of another scheme than http, with a user's name, or
/// with
///   another host than the field Host.
/// In the query '+' is a space, as forms write it; parameters without '=' have an empty value.
std::optional<Problem> readTarget(std::string_view target, std::optional<std::string_view> host, Request& request);

}  // namespace sgm::service::http

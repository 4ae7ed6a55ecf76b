#pragma once
// Finds the route, and thus the endpoint, for an HTTP request.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tools/service/http/message.h"

namespace sgm::service {

/// A path pattern of a server, and the methods that it allows.
struct Route {
  std::string_view path;     ///< path pattern; a segment in braces matches any segment: "/api/v1/reports/{id}"
  std::string_view methods;  ///< allowed methods in the format of the header Allow: "GET, HEAD"
  int endpoint = 0;          ///< endpoint that handles the route, a number that the owner of the table chooses
};

struct Routed {
  const Route* route = nullptr;
  std::vector<std::string> values;  ///< segments of the request's path that match segments in braces, in order
};

/// The first route that matches a request. If there is none, the answer: 404, or 405 with the header Allow.
std::variant<Routed, http::Response> routed(std::span<const Route> routes, const http::Request& request);

}  // namespace sgm::service

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
  /// number of the endpoint that handles the route; the owner of the route table chooses these numbers
  int endpoint = 0;
};

struct Routed {
  const Route* route = nullptr;
  std::vector<std::string> values;  ///< the segments of the request's path that match segments in braces, in the order
                                    ///< of the path
};

/// The first route that matches a request. If there is none, the answer: 404, or 405 with the header Allow.
std::variant<Routed, http::Response> routed(std::span<const Route> routes, const http::Request& request);

}  // namespace sgm::service

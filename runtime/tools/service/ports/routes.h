#pragma once
// Finds the endpoint that handles a request.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tools/service/http/message.h"

namespace sgm::service {

/// A path of a server, and its allowed methods.
struct Route {
  std::string_view path;     ///< segments in braces match any segment: "/api/v1/reports/{id}"
  std::string_view methods;  ///< in the form of the field Allow: "GET, HEAD"
  int endpoint = 0;          ///< number that identifies the endpoint for the route's owner
};

struct Routed {
  const Route* route = nullptr;
  std::vector<std::string> values;  ///< the request's segments that match segments in braces, in order
};

/// The first route that matches a request; or, if there is none, the answer: 404, or 405 with the field Allow.
std::variant<Routed, http::Response> routed(std::span<const Route> routes, const http::Request& request);

}  // namespace sgm::service

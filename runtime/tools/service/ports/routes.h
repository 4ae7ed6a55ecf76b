#pragma once
// Finds the endpoint of a request.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tools/service/http/message.h"

namespace sgm::service {

/// A path of a server, with its allowed methods.
struct Route {
  std::string_view path;     ///< segments in braces match any segment: "/api/v1/reports/{id}"
  std::string_view methods;  ///< in the form of Allow: "GET, HEAD"
  int endpoint = 0;          ///< its owner's number for it
};

struct Routed {
  const Route* route = nullptr;
  std::vector<std::string> values;  ///< of the segments in braces, in order
};

/// The first route that matches a request; or the answer if there is none: 404, or 405 with Allow.
std::variant<Routed, http::Response> routed(std::span<const Route> routes, const http::Request& request);

}  // namespace sgm::service

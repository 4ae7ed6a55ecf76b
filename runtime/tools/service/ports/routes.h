#pragma once
// Which endpoint a request is for.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tools/service/http/message.h"

namespace sgm::service {

/// One path of a server, and what may be done with it.
struct Route {
  std::string_view path;     ///< segments in braces stand for any one: "/api/v1/reports/{id}"
  std::string_view methods;  ///< as Allow has them: "GET, HEAD"
  int endpoint = 0;          ///< its owner's number for it
};

struct Routed {
  const Route* route = nullptr;
  std::vector<std::string> values;  ///< of the segments in braces, in order
};

/// The route that a request is for; or the answer where there is none: 404, or 405 with Allow. The first that fits.
std::variant<Routed, http::Response> routed(std::span<const Route> routes, const http::Request& request);

}  // namespace sgm::service

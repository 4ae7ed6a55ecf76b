#include "tools/service/ports/routes.h"

namespace sgm::service {
namespace {

/// Removes the first segment of the path and the '/' behind it, and returns the segment.
std::string_view takeSegment(std::string_view& path) {
  const size_t end = path.find('/');
  const std::string_view segment = path.substr(0, end);
  path = end == path.npos ? std::string_view{} : path.substr(end + 1);
  return segment;
}

std::optional<std::vector<std::string>> valuesOf(std::string_view pattern, std::string_view path) {
  std::vector<std::string> values;
  pattern.remove_prefix(1);
  path.remove_prefix(1);
  if (pattern.ends_with('/') != path.ends_with('/')) return std::nullopt;
  while (!pattern.empty() || !path.empty()) {
    const std::string_view wanted = takeSegment(pattern), segment = takeSegment(path);
    const bool any = wanted.starts_with('{');
    if (any ? segment.empty() : segment != wanted) return std::nullopt;
    if (any) values.emplace_back(segment);
  }
  return values;
}

bool allows(std::string_view methods, std::string_view method) {
  while (!methods.empty()) {
    const size_t end = methods.find(", ");
    if (methods.substr(0, end) == method) return true;
    methods = end == methods.npos ? std::string_view{} : methods.substr(end + 2);
  }
  return false;
}

}  // namespace

std::variant<Routed, http::Response> routed(std::span<const Route> routes, const http::Request& request) {
  for (const Route& route : routes) {
    std::optional<std::vector<std::string>> values = valuesOf(route.path, request.path);
    if (!values) continue;
    if (allows(route.methods, request.method)) return Routed{&route, std::move(*values)};
    http::Response response = makeResponse(
        http::Problem{405, "method_not_allowed", "this path supports " + std::string(route.methods) + " only", ""});
    response.fields.push_back({"Allow", std::string(route.methods)});
    return response;
  }
  return makeResponse(
      http::Problem{404, "not_found", "this path does not exist; /api/v1/openapi.json lists all paths", ""});
}

}  // namespace sgm::service

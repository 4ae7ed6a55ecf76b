// Tests that paths and methods select their endpoints, or 404 and 405.

#include "tools/service/ports/routes.h"

#include "../catch.h"

namespace sgm::service {
namespace {

constexpr Route kRoutes[] = {
    {"/", "GET, HEAD", 0}, {"/a/b", "GET, HEAD, PUT", 1}, {"/a/{x}", "POST", 2}, {"/a/{x}/c/{y}", "GET", 3}};

std::variant<Routed, http::Response> find(const std::string& method, const std::string& path) {
  http::Request request;
  request.method = method;
  request.path = path;
  return routed(kRoutes, request);
}

int statusFor(const std::string& method, const std::string& path) {
  const auto found = find(method, path);
  return std::holds_alternative<Routed>(found) ? 200 : std::get<http::Response>(found).status;
}

}  // namespace

TEST_CASE("a path leads to its endpoint, with the values of its braces") {
  CHECK(std::get<Routed>(find("GET", "/")).route->endpoint == 0);
  CHECK(std::get<Routed>(find("PUT", "/a/b")).route->endpoint == 1);
  const auto found = find("GET", "/a/one/c/two words");
  const Routed& to = std::get<Routed>(found);
  CHECK(to.route->endpoint == 3);
  CHECK(to.values == std::vector<std::string>{"one", "two words"});
  CHECK(std::get<Routed>(find("POST", "/a/x")).values == std::vector<std::string>{"x"});
}

TEST_CASE("what is nowhere is a 404, what may not be done a 405 that says what may") {
  for (const char* path : {"/a", "/a/", "/a/b/", "/a/b/c", "/a//c/d", "/a/x/c/", "/A/b", "/b"})
    CHECK(statusFor("GET", path) == 404);
  CHECK(statusFor("GE", "/a/b") == 405);
  CHECK(statusFor("get", "/a/b") == 405);
  CHECK(statusFor("", "/a/b") == 405);
  const auto found = find("DELETE", "/a/b");
  const http::Response& response = std::get<http::Response>(found);
  CHECK(response.status == 405);
  REQUIRE_FALSE(response.fields.empty());
  CHECK(response.fields[0].name == "Allow");
  CHECK(response.fields[0].value == "GET, HEAD, PUT");
}

}  // namespace sgm::service

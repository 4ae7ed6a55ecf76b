// Tests the port for operators, without sockets.

#include "tools/service/ports/operations.h"

#include <nlohmann/json.hpp>

#include "../catch.h"

namespace sgm::service {
namespace {

using nlohmann::json;

http::Response ask(Operations& operations, const std::string& method, const std::string& path,
                   std::vector<http::Field> fields = {}) {
  http::Request request;
  request.method = method;
  request.path = path;
  request.fields = std::move(fields);
  if (request.fields.empty() || request.fields[0].name != "none") request.fields.push_back({"Host", "localhost"});
  http::Admission admission = operations.admit(request);
  if (admission.refusal) return *admission.refusal;
  CHECK_FALSE(admission.body);
  http::Response answer;
  operations.answer(request, nullptr, [&](http::Response response) { answer = std::move(response); });
  return answer;
}

}  // namespace

TEST_CASE("life and metrics") {
  const Access access = *Access::create({});
  Operations operations({access, [] { return std::string("sgm_worlds 0\n"); }, [] { return std::vector<Check>(); }});
  CHECK(*ask(operations, "GET", "/healthz").body == "ok\n");
  const http::Response metrics = ask(operations, "GET", "/metrics");
  CHECK(metrics.type == "text/plain; version=0.0.4; charset=utf-8");
  CHECK(*metrics.body == "sgm_worlds 0\n");
  CHECK(ask(operations, "POST", "/metrics").status == 405);
  CHECK(ask(operations, "GET", "/").status == 404);
}

TEST_CASE("metrics need the token, life does not") {
  const Access access = *Access::create({"127.0.0.1", "0123456789abcdef", {}});
  Operations operations({access, [] { return std::string("x 0\n"); }, [] { return std::vector<Check>(); }});
  CHECK(ask(operations, "GET", "/healthz").status == 200);
  CHECK(ask(operations, "GET", "/readyz").status == 200);
  CHECK(ask(operations, "GET", "/metrics").status == 401);
  CHECK(ask(operations, "GET", "/metrics", {{"Authorization", "Bearer 0123456789abcdef"}}).status == 200);
}

TEST_CASE("a probe without Host is answered, and strangers are told no more than they need") {
  const Access access = *Access::create({"127.0.0.1", "0123456789abcdef", {}});
  Operations operations({access, [] { return std::string(); },
                         [] {
                           return std::vector<Check>{{"world secret", true, true, "is sampled"}};
                         }});
  CHECK(ask(operations, "GET", "/healthz", {{"none", ""}}).status == 200);
  CHECK(ask(operations, "GET", "/metrics", {{"none", ""}}).status == 421);
  CHECK(json::parse(*ask(operations, "GET", "/readyz").body)["checks"].empty());
  const http::Response known = ask(operations, "GET", "/readyz", {{"Authorization", "Bearer 0123456789abcdef"}});
  CHECK(json::parse(*known.body)["checks"].size() == 1);
}

TEST_CASE("a service is ready unless something that it needs is not there") {
  const Access access = *Access::create({});
  std::vector<Check> checks;
  Operations operations({access, [] { return std::string(); }, [&] { return checks; }});
  const auto is = [&](int status, bool degraded) {
    const http::Response said = ask(operations, "GET", "/readyz");
    const json body = json::parse(*said.body);
    CHECK(said.status == status);
    CHECK(body["ready"] == (status == 200));
    CHECK(body["degraded"] == degraded);
    CHECK(body["checks"].size() == checks.size());
  };
  is(200, false);
  checks = {{"validator", true, false, "accepts uploads"}, {"world a", true, true, "is sampled"}};
  is(200, false);
  checks[0].ok = false;
  is(200, true);
  checks[1].ok = false;
  checks[1].detail = "not UTF-8: \xff";
  is(503, true);
}

}  // namespace sgm::service

// Tests access control: the host names of this server, requests from pages of other sites, the token.

#include "tools/service/ports/access.h"

#include "../catch.h"

namespace sgm::service {
namespace {

const std::string kToken = "0123456789abcdef";

Access accessWith(const AccessSettings& settings) {
  Result<Access> access = Access::create(settings);
  REQUIRE(access);
  return *access;
}

http::Request requestWith(std::vector<http::Field> fields) {
  http::Request request;
  request.method = "GET";
  request.path = "/";
  request.fields = std::move(fields);
  return request;
}

int statusOf(const std::optional<http::Response>& refusal) { return refusal ? refusal->status : 200; }

int statusFor(const Access& access, const std::string& host, const std::string& origin = "") {
  std::vector<http::Field> fields{{"Host", host}};
  if (!origin.empty()) fields.push_back({"origin", origin});
  return statusOf(access.refuse(requestWith(fields)));
}

}  // namespace

TEST_CASE("only names of this server are answered to") {
  const Access access = accessWith({"127.0.0.1", "", {"Build-Box.local"}});
  for (const char* host :
       {"127.0.0.1", "127.0.0.1:8464", "localhost", "LOCALHOST:1", "[::1]:8464", "build-box.local:80"})
    CHECK(statusFor(access, host) == 200);
  for (const char* host :
       {"", "evil.example", "evil.example:8464", "127.0.0.1.evil.example", "localhost.evil.example", "10.0.0.7",
        "[::1]evil", "localhost:1:2]", "localhost:x", "[::1", "[::2]", ":8464", "127.0.0.1@evil.example"})
    CHECK(statusFor(access, host) == 421);
  CHECK(statusOf(access.refuse(requestWith({}))) == 421);
}

TEST_CASE("where all addresses are listened on any address is a name, and no other") {
  for (const char* any : {"0.0.0.0", "::"}) {
    const Access access = accessWith({any, kToken, {}});
    CHECK(statusFor(access, "10.0.0.7:8464") == 200);
    CHECK(statusFor(access, "[fe80::1]:8464") == 200);
    CHECK(statusFor(access, "evil.example") == 421);
  }
}

TEST_CASE("pages of other sites may not ask") {
  const Access access = accessWith({});
  CHECK(statusFor(access, "127.0.0.1:8464", "http://127.0.0.1:8464") == 200);
  CHECK(statusFor(access, "localhost:8464", "https://localhost:8464") == 200);
  for (const char* origin :
       {"null", "http://evil.example", "http://127.0.0.1:9999", "http://127.0.0.1:8464.evil.example",
        "http://localhost:8464", "file://", "127.0.0.1:8464"})
    CHECK(statusFor(access, "127.0.0.1:8464", origin) == 403);
}

TEST_CASE("the token, where there is one") {
  CHECK(statusOf(accessWith({}).refuseStranger(requestWith({}))) == 200);
  const Access access = accessWith({"127.0.0.1", kToken, {}});
  const auto with = [&](const std::string& value) {
    return statusOf(access.refuseStranger(requestWith({{"authorization", value}})));
  };
  CHECK(with("Bearer " + kToken) == 200);
  CHECK(with("bearer " + kToken) == 200);
  for (const std::string& value :
       std::vector<std::string>{"", "Bearer ", kToken, "Basic " + kToken, "Bearer " + kToken + "x", "Bearer x" + kToken,
                                "Bearer " + kToken.substr(1), "Bearer 0123456789abcdeg"})
    CHECK(with(value) == 401);
  const std::optional<http::Response> refusal = access.refuseStranger(requestWith({}));
  REQUIRE(refusal);
  REQUIRE(refusal->fields.size() == 1);
  CHECK(refusal->fields[0].name == "WWW-Authenticate");
}

TEST_CASE("what others can reach needs a token") {
  CHECK(isLoopback("127.0.0.1"));
  CHECK(isLoopback("127.8.0.1"));
  CHECK(isLoopback("::1"));
  for (const char* address : {"0.0.0.0", "::", "10.0.0.1", "localhost", "", "128.0.0.1", "::2"})
    CHECK_FALSE(isLoopback(address));
  const auto codeOf = [](const AccessSettings& settings) { return Access::create(settings).error().code; };
  for (const char* address : {"0.0.0.0", "::", "192.168.1.2", "localhost", "", "127.0.0.1 "})
    CHECK(codeOf({address, "", {}}) == Code::invalid_argument);
  for (const char* token :
       {"short", "0123456789abcde", "0123456789abcdef ", "0123456789abcde\n", "0123456789abcde\xc3\xa4"})
    CHECK(codeOf({"127.0.0.1", token, {}}) == Code::invalid_argument);
  for (const char* name : {"", "a b", "a/b", "a:1", "*"})
    CHECK(codeOf({"127.0.0.1", "", {name}}) == Code::invalid_argument);
}

}  // namespace sgm::service

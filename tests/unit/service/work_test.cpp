// Tests the port for users and programs, without sockets: which requests are accepted, and the answers.

#include "tools/service/ports/work.h"

#include <deque>
#include <nlohmann/json.hpp>

#include "../catch.h"
#include "tools/service/judge/request_bodies.h"

namespace sgm::service {
namespace {

using http::Request;
using http::Response;
using nlohmann::json;

/// An inspector that ends its inspections only when the test tells it to.
class HeldInspector final : public Inspector {
 public:
  Result<void> wouldTake() const override {
    if (!works) return Error{Code::unsupported, "no program"};
    if (held.size() >= room) return Error{Code::limit, "full"};
    return {};
  }
  Result<void> inspect(Upload upload, std::function<void()> began, std::function<void(Inspection)> done) override {
    if (Result<void> taken = wouldTake(); !taken) return taken;
    held.push_back({std::move(upload), std::move(began), std::move(done)});
    return {};
  }
  void readMasters(std::function<void(Inspection)> done) override { ++reads, done({200, "{\"masters\":[]}", {}}); }
  void writeMasters(std::string text, std::function<void(Inspection)> done) override {
    written = std::move(text);
    done({422, "{\"status\":422}", {}});
  }
  InspectorCounts counts() const override { return {}; }

  struct Held {
    Upload upload;
    std::function<void()> began;
    std::function<void(Inspection)> done;
  };
  std::deque<Held> held;
  size_t room = 2;
  bool works = true;
  int reads = 0;
  std::string written;
};

class NoWorlds final : public WatchedWorlds {
 public:
  Result<void> watch(const std::string&, sgm_world*) override { return {}; }
  void forget(sgm_world*) override {}
  std::vector<WorldSample> samples() const override { return {}; }
  std::optional<WorldMap> map(const std::string&) override { return std::nullopt; }
};

struct Fixture {
  Access access = *Access::create({});
  HeldInspector inspector;
  Masters masters{inspector};
  Reports reports;
  NoWorlds worlds;
  WorkSettings settings;
  std::unique_ptr<Work> work;

  Fixture() { remake(); }
  void remake() {
    work = std::make_unique<Work>(WorkParts{access, inspector, masters, reports, worlds, [] { return ServiceState{}; }},
                                  settings);
  }

  Request request(const std::string& method, const std::string& path, std::vector<http::Field> fields = {}) {
    Request made;
    made.method = method;
    made.path = path;
    made.fields = std::move(fields);
    made.fields.push_back({"Host", "localhost"});
    return made;
  }
  /// The answer that a server would send; empty until the port has answered.
  std::shared_ptr<std::optional<Response>> ask(const Request& request, const std::string& body = "") {
    auto answer = std::make_shared<std::optional<Response>>();
    http::Admission admission = work->admit(request);
    if (admission.refusal) {
      *answer = std::move(admission.refusal);
      return answer;
    }
    if (admission.body) {
      REQUIRE(admission.max_bytes >= body.size());
      REQUIRE_FALSE(admission.body->take(body));
    }
    work->answer(request, std::move(admission.body), [answer](Response response) { *answer = std::move(response); });
    return answer;
  }
  int statusOf(const Request& request, const std::string& body = "") {
    const auto answer = ask(request, body);
    REQUIRE(*answer);
    return (*answer)->status;
  }
  Request upload(const std::string& type, const std::string& name = "") {
    Request made = request("POST", "/api/v1/validate", {{"Content-Type", type}});
    if (!name.empty()) made.query.emplace_back("name", name);
    return made;
  }
};

std::string fieldOf(const Response& response, const std::string& name) {
  for (const http::Field& field : response.fields)
    if (field.name == name) return field.value;
  return "";
}

}  // namespace

TEST_CASE_METHOD(Fixture, "the page comes with a policy and a tag") {
  const auto page = ask(request("GET", "/"));
  REQUIRE((*page)->status == 200);
  CHECK((*page)->type == "text/html; charset=utf-8");
  CHECK(fieldOf(**page, "Content-Security-Policy").find("default-src 'none'") == 0);
  const std::string tag = fieldOf(**page, "ETag");
  REQUIRE(tag.size() > 2);
  CHECK(statusOf(request("GET", "/", {{"If-None-Match", tag}})) == 304);
  CHECK(statusOf(request("GET", "/", {{"If-None-Match", "\"other\""}})) == 200);
  CHECK(statusOf(request("GET", "/", {{"If-None-Match", "\"other, one\", W/" + tag}})) == 304);
  CHECK(statusOf(request("GET", "/", {{"If-None-Match", "*"}})) == 304);
  CHECK((*page)->body == (*ask(request("GET", "/")))->body);
  CHECK(statusOf(request("POST", "/")) == 405);
  CHECK(statusOf(request("GET", "/openapi.json")) == 404);
  const auto description = ask(request("GET", "/api/v1/openapi.json"));
  CHECK(json::parse(*(*description)->body)["openapi"].get<std::string>().substr(0, 2) == "3.");
}

TEST_CASE_METHOD(Fixture, "nobody without the token gets past the page") {
  access = *Access::create({"127.0.0.1", "0123456789abcdef", {}});
  CHECK(statusOf(request("GET", "/")) == 200);
  for (const char* path : {"/api/v1/summary", "/api/v1/reports", "/api/v1/masters", "/api/v1/openapi.json", "/nothing"})
    CHECK(statusOf(request("GET", path)) == 401);
  CHECK(statusOf(request("GET", "/api/v1/reports", {{"Authorization", "Bearer 0123456789abcdef"}})) == 200);
}

TEST_CASE_METHOD(Fixture, "an upload waits, runs, and is answered with its report") {
  const auto answer = ask(upload("model/gltf-binary", "a.glb"), "bytes");
  CHECK_FALSE(*answer);
  REQUIRE(inspector.held.size() == 1);
  CHECK(inspector.held[0].upload.kind == UploadKind::glb);
  CHECK(inspector.held[0].upload.bytes() == 5);
  inspector.held[0].began();
  const json list = json::parse(*(*ask(request("GET", "/api/v1/reports")))->body);
  REQUIRE(list["reports"].size() == 1);
  CHECK(list["reports"][0]["state"] == "running");
  inspector.held[0].done({200, R"({"valid":true,"measures":{"area":1.5}})", "SGMPREV1"});
  REQUIRE(*answer);
  CHECK((*answer)->status == 200);
  const json report = json::parse(*(*answer)->body);
  CHECK(report["state"] == "done");
  CHECK(report["valid"] == true);
  CHECK(report["measures"]["area"] == 1.5);
  const std::string at = fieldOf(**answer, "Location");
  CHECK(at == "/api/v1/reports/" + report["id"].get<std::string>());
  CHECK(json::parse(*(*ask(request("GET", at)))->body) == report);
  CHECK(*(*ask(request("GET", at + "/preview")))->body == "SGMPREV1");
}

TEST_CASE_METHOD(Fixture, "who does not want to wait is told where the report will be") {
  Request request = upload("model/stl");
  request.fields.push_back({"prefer", "respond-async, wait=5"});
  const auto answer = ask(request, "solid");
  REQUIRE(*answer);
  CHECK((*answer)->status == 202);
  const std::string at = fieldOf(**answer, "Location");
  CHECK(json::parse(*(*answer)->body)["state"] == "waiting");
  inspector.held[0].began();
  inspector.held[0].done({422, R"({"status":422,"code":"bad_input","detail":"d"})", {}});
  const json report = json::parse(*(*ask(this->request("GET", at)))->body);
  CHECK(report["state"] == "failed");
  CHECK(report["problem"]["code"] == "bad_input");
}

TEST_CASE_METHOD(Fixture, "a refused mesh is answered with its problem") {
  const auto answer = ask(upload("model/obj"), "x");
  inspector.held[0].began();
  inspector.held[0].done({422, R"({"status":422,"code":"bad_input"})", {}});
  CHECK((*answer)->status == 422);
  CHECK((*answer)->type == "application/problem+json");
  CHECK(json::parse(*(*answer)->body)["code"] == "bad_input");
}

TEST_CASE_METHOD(Fixture, "kinds are known by type or by name") {
  struct Row {
    const char *type, *name;
    int status;
  };
  for (const Row& row : {Row{"text/plain", "a.glb", 415}, Row{"multipart/form-data; boundary=x", "a.glb", 415},
                         Row{"application/octet-stream", "a.exe", 415}, Row{"application/octet-stream", "", 415},
                         Row{"application/x-www-form-urlencoded", "", 415}}) {
    CAPTURE(row.type, row.name);
    CHECK(statusOf(upload(row.type, row.name)) == row.status);
  }
  inspector.room = 5;
  for (const Row& row : {Row{"model/gltf-binary", "", 0}, Row{"application/octet-stream", "A.PLY", 0},
                         Row{"model/stl; charset=x", "", 0}, Row{"text/x-sgm", "", 0}, Row{"", "x.obj", 0}}) {
    CAPTURE(row.type, row.name);
    CHECK_FALSE(*ask(upload(row.type, row.name), "x"));
  }
}

TEST_CASE_METHOD(Fixture, "parameters that say nothing are refused") {
  Request request = upload("model/stl");
  request.query.emplace_back("seed", "1");
  CHECK(statusOf(request) == 400);
  request = upload("text/x-sgm");
  request.query = {{"seed", "1"}, {"set", "a=1"}, {"set", "b=2"}};
  CHECK_FALSE(*ask(request, "sgm 1;"));
  CHECK(inspector.held.back().upload.options.size() == 3);
  request.query.emplace_back("depth", "1");
  CHECK(statusOf(request) == 400);
  CHECK(statusOf(upload("model/stl", std::string(256, 'a'))) == 400);
}

TEST_CASE_METHOD(Fixture, "a full queue, and no program, are said before the body comes") {
  for (int i = 0; i < 2; ++i) CHECK_FALSE(*ask(upload("model/stl"), "x"));
  const auto full = ask(upload("model/stl"), "x");
  REQUIRE(*full);
  CHECK((*full)->status == 503);
  CHECK_FALSE(fieldOf(**full, "Retry-After").empty());
  CHECK(json::parse(*(*full)->body)["code"] == "queue_full");
  inspector.works = false;
  CHECK(json::parse(*(*ask(upload("model/stl"), "x"))->body)["code"] == "no_validator");
}

TEST_CASE_METHOD(Fixture, "only so many bytes come in at one time, and there is room again when an upload ends") {
  settings.max_incoming_bytes = 20;
  settings.max_upload_bytes = 10;
  remake();
  const http::Admission idle = work->admit(upload("model/stl"));
  {
    const http::Admission a = work->admit(upload("model/stl")), b = work->admit(upload("model/stl"));
    CHECK_FALSE(a.body->take("123456789"));
    CHECK_FALSE(b.body->take("123456789"));
    const std::optional<Response> full = idle.body->take("123");
    REQUIRE(full);
    CHECK(full->status == 503);
    CHECK_FALSE(fieldOf(*full, "Retry-After").empty());
  }
  const http::Admission next = work->admit(upload("model/stl"));
  CHECK_FALSE(next.body->take("1234567890"));
}

TEST_CASE_METHOD(Fixture, "an upload that cannot be kept is a 507") {
  settings.upload_folder = "/nowhere/at/all";
  remake();
  CHECK(statusOf(upload("model/stl")) == 507);
}

TEST_CASE_METHOD(Fixture, "masters are read once for all who ask, and written as they come") {
  for (int i = 0; i < 3; ++i) CHECK(statusOf(request("GET", "/api/v1/masters")) == 200);
  CHECK(inspector.reads == 1);
  CHECK(statusOf(request("PUT", "/api/v1/masters", {{"Content-Type", "application/json"}}), "{}") == 409);
  settings.masters_writable = true;
  remake();
  CHECK(statusOf(request("PUT", "/api/v1/masters", {{"Content-Type", "text/plain"}}), "{}") == 415);
  {
    std::vector<http::Admission> coming;
    for (int i = 0; i < 5; ++i)
      coming.push_back(
          work->admit(request("PUT", "/api/v1/masters", {{"Content-Type", "Application/JSON ; charset=utf-8"}})));
    const std::string four(size_t{4} << 20, 'a');
    for (size_t i = 0; i < 4; ++i) CHECK_FALSE(coming[i].body->take(four));
    const std::optional<Response> full = coming[4].body->take("a");
    REQUIRE(full);
    CHECK(full->status == 503);
  }
  CHECK(statusOf(request("PUT", "/api/v1/masters", {{"Content-Type", "application/json"}}), "{\"a\":1}") == 422);
  CHECK(inspector.written == "{\"a\":1}");
}

TEST_CASE_METHOD(Fixture, "what is not there is a 404") {
  for (const char* path : {"/api/v1/reports/0123456789abcdef", "/api/v1/reports/0123456789abcdef/preview",
                           "/api/v1/worlds/cave/chunks", "/api", "/api/v1/", "/nothing.js"})
    CHECK(statusOf(request("GET", path)) == 404);
}

}  // namespace sgm::service

#include "tools/service/judge/reports.h"

#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "../catch.h"
#include "scripts.h"

using namespace sgm;
using namespace sgm::service;
using Json = nlohmann::json;

namespace {

Inspection goodInspection(std::string preview = smallPreview()) {
  Inspection said;
  said.json = R"({"valid":true,"measures":{"area":1.5},"id":"forged","classification":null,"preview":{"points":3}})";
  said.preview = std::move(preview);
  said.valid = true;
  return said;
}

Json jsonOf(const Reports& reports, const std::string& id) {
  const std::optional<std::string> text = reports.json(id);
  REQUIRE(text);
  return Json::parse(*text);
}

}  // namespace

TEST_CASE("a report says how far it is, and what was found out") {
  Reports reports;
  const std::string id = reports.begin("a \"b\" \xFF.glb", UploadKind::glb, 123);
  REQUIRE(id.size() == 16);
  CHECK(std::ranges::all_of(id, [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); }));
  Json json = jsonOf(reports, id);
  CHECK(json["id"] == id);
  CHECK(json["name"] == "a \"b\" \uFFFD.glb");
  CHECK(json["kind"] == "glb");
  CHECK(json["bytes"] == 123);
  CHECK(json["state"] == "waiting");
  CHECK(json["valid"].is_null());
  CHECK(json["received"].get<std::string>().size() == 20);
  reports.run(id);
  CHECK(jsonOf(reports, id)["state"] == "running");
  CHECK(reports.preview(id) == nullptr);

  const std::string told = reports.finish(id, goodInspection());
  CHECK(told == *reports.json(id));
  json = jsonOf(reports, id);
  CHECK(json["id"] == id);
  CHECK(json["state"] == "done");
  CHECK(json["valid"] == true);
  CHECK(json["seconds"].get<double>() >= 0);
  CHECK(json["measures"]["area"] == 1.5);
  CHECK(json["classification"].is_null());
  CHECK(json["preview"]["url"] == "/api/v1/reports/" + id + "/preview");
  CHECK(json["preview"]["points"] == 3);
  REQUIRE(reports.preview(id) != nullptr);
  CHECK(*reports.preview(id) == smallPreview());
}

TEST_CASE("a report without a preview links to none") {
  Reports reports;
  const std::string id = reports.begin("a.glb", UploadKind::glb, 1);
  reports.finish(id, goodInspection(""));
  CHECK(jsonOf(reports, id)["preview"].is_null());
  CHECK(reports.preview(id) == nullptr);
}

TEST_CASE("a report of what could not be read holds the problem") {
  Reports reports;
  const std::string bad = reports.begin("a.obj", UploadKind::obj, 1), late = reports.begin("b.obj", UploadKind::obj, 2);
  reports.run(bad);
  reports.finish(bad, {422, R"({"status":422,"code":"bad_input","detail":"why"})", {}});
  reports.finish(late, {503, R"({"status":503,"code":"stopping"})", {}});
  const Json json = jsonOf(reports, bad);
  CHECK(json["state"] == "failed");
  CHECK(json["problem"]["detail"] == "why");
  CHECK(json["valid"].is_null());
  CHECK_FALSE(json.contains("status"));
  CHECK(jsonOf(reports, late)["state"] == "cancelled");
}

TEST_CASE("unknown reports are nothing") {
  Reports reports;
  CHECK_FALSE(reports.json("0123456789abcdef"));
  CHECK_FALSE(reports.json(""));
  CHECK(reports.preview("x") == nullptr);
  reports.run("x");
  CHECK(reports.finish("x", goodInspection()).empty());
  CHECK(reports.size() == 0);
  CHECK(Json::parse(reports.list())["reports"].empty());
}

TEST_CASE("the last 64 reports are kept, and all that are not finished") {
  Reports reports;
  std::vector<std::string> ids;
  for (int i = 0; i < 200; ++i) {
    ids.push_back(reports.begin("r" + std::to_string(i), UploadKind::stl, 1));
    reports.finish(ids.back(), goodInspection());
    CHECK(reports.size() <= 64);
  }
  CHECK(std::set<std::string>(ids.begin(), ids.end()).size() == ids.size());
  CHECK_FALSE(reports.json(ids[135]));
  CHECK(reports.json(ids[136]));
  const Json list = Json::parse(reports.list())["reports"];
  REQUIRE(list.size() == 64);
  for (size_t i = 0; i < 64; ++i) CHECK(list[i]["id"] == ids[199 - i]);
  CHECK_FALSE(list[0].contains("measures"));
  CHECK(list[0]["valid"] == true);

  std::vector<std::string> open;
  for (int i = 0; i < 100; ++i) open.push_back(reports.begin("open", UploadKind::stl, 1));
  CHECK(reports.size() == 100);
  for (const std::string& id : open) CHECK(reports.json(id));
  // The report that was finished last can be fetched, however many jobs wait.
  reports.finish(open[0], goodInspection());
  CHECK(reports.json(open[0]));
  reports.finish(open[1], goodInspection());
  CHECK(reports.json(open[1]));
  CHECK_FALSE(reports.json(open[0]));
}

TEST_CASE("reports keep to 128 MiB together") {
  Reports reports;
  std::vector<std::string> ids;
  for (int i = 0; i < 7; ++i) {
    ids.push_back(reports.begin("large", UploadKind::glb, 1));
    reports.finish(ids.back(), goodInspection(std::string(size_t{30} << 20, 'x')));
  }
  CHECK(reports.size() == 4);
  CHECK_FALSE(reports.json(ids[2]));
  for (size_t i = 3; i < 7; ++i) CHECK(reports.json(ids[i]));
}

TEST_CASE("reports are written and read by many threads", "[threads]") {
  Reports reports;
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) {
        const std::string id = reports.begin("a", UploadKind::ply, 7);
        reports.run(id);
        const std::string text = reports.finish(id, goodInspection());
        if (Json::parse(text)["id"] != id) ++wrong;
        static_cast<void>(reports.json(id));
        static_cast<void>(reports.preview(id));
        if (!Json::parse(reports.list())["reports"].is_array()) ++wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
  CHECK(reports.size() == 64);
}

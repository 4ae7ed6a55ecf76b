// Tests inspections and reports while memory runs out.

#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>

#include "../http/failing_heap.h"
#include "scripts.h"
#include "tools/service/judge/inspector.h"
#include "tools/service/judge/reports.h"

using namespace sgm;
using namespace sgm::service;
using Json = nlohmann::json;

namespace {

/// Records the callbacks of an inspector. Each callback also ends the simulated lack of memory.
class Told {
 public:
  void tell(Inspection said) {
    mendHeap();
    const std::lock_guard lock(mutex_);
    all_.push_back(std::move(said));
    changed_.notify_all();
  }
  bool waitFor(size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(60), [&] { return all_.size() >= count; });
  }
  const std::vector<Inspection>& all() const { return all_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Inspection> all_;
};

std::unique_ptr<Inspector> inspectorOf(const std::string& program) {
  InspectorSettings settings;
  settings.program = program;
  settings.jobs = 1;
  Result<std::unique_ptr<Inspector>> made = Inspector::create(settings);
  REQUIRE(made);
  return std::move(*made);
}

Upload uploadOf(const std::string& content) {
  Result<Upload> upload = Upload::create("");
  REQUIRE(upload);
  REQUIRE(upload->append(content));
  return std::move(*upload);
}

Inspection inspectionWith(const std::string& measures) {
  Inspection said;
  said.json = R"({"valid":true,"measures":)" + measures + R"(,"preview":null})";
  said.valid = true;
  return said;
}

}  // namespace

TEST_CASE("who waits is told of memory that has run out", "[threads]") {
  const TemporaryFolder files;
  Told told;
  {
    const std::unique_ptr<Inspector> inspector = inspectorOf(makeScript(files, "inspect.sh", "exec sleep 1000"));
    REQUIRE(inspector->inspect(
        uploadOf("x"), [] { failHeap(0, true); }, [&](Inspection said) { told.tell(std::move(said)); }));
    REQUIRE(told.waitFor(1));
    CHECK(inspector->counts().failed == 1);
    CHECK(inspector->counts().running == 0);
    // One job runs; when it ends, there is no memory to start the next job, not even to report an error.
    REQUIRE(inspector->inspect(
        uploadOf("x"), [] {},
        [&](Inspection said) {
          told.tell(std::move(said));
          failHeap(0, true);
        }));
    REQUIRE(inspector->inspect(
        uploadOf("x"), [] {}, [&](Inspection said) { told.tell(std::move(said)); }));
    while (inspector->counts().running == 0) usleep(1000);
  }
  REQUIRE(told.all().size() == 3);
  CHECK(told.all()[0].status == 500);
  CHECK(Json::parse(told.all()[0].json)["code"] == "validator_limit");
  CHECK(told.all()[1].status == 503);
  CHECK(told.all()[2].status == 500);
  CHECK(Json::parse(told.all()[2].json)["code"] == "validator_limit");
}

TEST_CASE("without memory nothing is queued, and that is said") {
  const TemporaryFolder files;
  const std::unique_ptr<Inspector> inspector = inspectorOf(makeScript(files, "inspect.sh", "exit 3"));
  // Makes each allocation of a call fail in turn. Allocations of the inspector's threads count as well, and their
  // failures must be survived, too.
  for (long after = 0; after < 12; ++after) {
    INFO(after);
    Told told;
    Upload upload = uploadOf("x");
    failHeap(after, true);
    const Result<void> taken = inspector->inspect(
        std::move(upload), [] {}, [&](Inspection said) { told.tell(std::move(said)); });
    if (taken) {
      REQUIRE(told.waitFor(1));
    } else {
      mendHeap();
      CHECK(taken.error().code == Code::limit);
    }
    Told of_masters;
    failHeap(after, true);
    inspector->readMasters([&](Inspection said) { of_masters.tell(std::move(said)); });
    REQUIRE(of_masters.waitFor(1));
    mendHeap();
    CHECK(of_masters.all()[0].status == 500);
  }
}

TEST_CASE("a report for which memory runs out has failed, and is not kept for ever") {
  const auto finishAfter = [](long after, bool for_good) {
    Reports reports;
    const std::string id = reports.begin("a.glb", UploadKind::glb, 1);
    reports.run(id);
    Inspection said = inspectionWith(R"({"area":1,"name":")" + std::string(1000, 'x') + "\"}");
    said.preview = smallPreview();
    failHeap(after, for_good);
    const std::string text = reports.finish(id, std::move(said));
    const bool failed = mendHeap();
    const Json json = Json::parse(reports.json(id).value());
    CHECK((json["state"] == "failed") == (failed && json.contains("problem")));
    CHECK((json["state"] == "done") == json.contains("measures"));
    CHECK((text.empty() || Json::parse(text) == json));
    if (json["state"] == "failed") {
      CHECK(json["id"] == id);
      CHECK(json["name"] == "a.glb");
      CHECK(json["valid"].is_null());
      CHECK(json["problem"]["code"] == "out_of_memory");
      CHECK(reports.preview(id) == nullptr);
    }
    for (int i = 0; i < 64; ++i) reports.finish(reports.begin("b", UploadKind::glb, 1), inspectionWith("{}"));
    CHECK_FALSE(reports.json(id));
    return failed;
  };
  for (const bool for_good : {false, true}) {
    long after = 0;
    while (finishAfter(after, for_good)) ++after;
    CHECK(after > 10);
  }
}

TEST_CASE("a report takes no more memory than its text, whatever stands in it") {
  std::string many = "[";
  for (int i = 0; i < 500'000; ++i) many += "[],";
  many += "0]";
  Reports reports;
  const std::string id = reports.begin("a.glb", UploadKind::glb, 1);
  Inspection said = inspectionWith("{\"many\":" + many + "}");
  failHeap(1000, false);
  const std::string text = reports.finish(id, std::move(said));
  CHECK_FALSE(mendHeap());
  CHECK(text.find(many) != std::string::npos);

  const TemporaryFolder files;
  const std::string script = "cat " + makeFile(files, "said", framed(inspectionWith("{\"many\":" + many + "}").json));
  const std::unique_ptr<Inspector> inspector = inspectorOf(makeScript(files, "inspect.sh", script));
  Told told;
  Upload upload = uploadOf("x");
  failHeap(1000, false);
  REQUIRE(inspector->inspect(
      std::move(upload), [] {},
      [&](Inspection of) {
        const bool much = mendHeap();
        if (much) of.status = 0;
        told.tell(std::move(of));
      }));
  REQUIRE(told.waitFor(1));
  CHECK(told.all()[0].status == 200);
}

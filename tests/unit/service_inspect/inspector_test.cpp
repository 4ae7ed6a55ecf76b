#include "tools/service/judge/inspector.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "scripts.h"

using namespace sgm;
using namespace sgm::service;
using Json = nlohmann::json;

namespace {

const std::string kValid = R"({"valid":true,"measures":{"area":1},"preview":{}})";

/// Records the callbacks of an inspector in the order of the calls.
class Told {
 public:
  void began(int job) {
    const std::lock_guard lock(mutex_);
    began_.push_back(job);
    changed_.notify_all();
  }
  void done(int job, Inspection said) {
    const std::lock_guard lock(mutex_);
    done_.emplace_back(job, std::move(said));
    changed_.notify_all();
  }
  bool waitForBegun(size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(60), [&] { return began_.size() >= count; });
  }
  /// Waits until `count` inspections are done. Returns false after a timeout.
  bool waitForDone(size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(60), [&] { return done_.size() >= count; });
  }
  std::vector<std::pair<int, Inspection>> allDone() const {
    const std::lock_guard lock(mutex_);
    return done_;
  }
  std::vector<int> allBegun() const {
    const std::lock_guard lock(mutex_);
    return began_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<int> began_;
  std::vector<std::pair<int, Inspection>> done_;
};

struct Bench {
  TemporaryFolder folder;
  InspectorSettings settings;
  Told told;
  std::unique_ptr<Inspector> inspector;

  explicit Bench(const std::string& lines, InspectorSettings with = {}) : settings(std::move(with)) {
    settings.program = makeScript(folder, "inspect.sh", lines);
    restart();
  }
  void restart() {
    Result<std::unique_ptr<Inspector>> made = Inspector::create(settings);
    REQUIRE(made);
    inspector = std::move(*made);
  }
  Result<void> send(int job, const std::string& content = "content") {
    Result<Upload> upload = Upload::create(folder.path.string());
    REQUIRE(upload);
    REQUIRE(upload->append(content));
    upload->name = "name " + std::to_string(job) + ".obj";
    upload->kind = UploadKind::obj;
    upload->options = {{"region", "0,0,0:1,1,1"}, {"set", "a=b"}, {"seed", ""}};
    return inspector->inspect(
        std::move(*upload), [this, job] { told.began(job); },
        [this, job](Inspection said) { told.done(job, std::move(said)); });
  }
  Inspection judge() {
    const size_t before = told.allDone().size();
    REQUIRE(send(1));
    REQUIRE(told.waitForDone(before + 1));
    return told.allDone().back().second;
  }
};

/// The lines of a script that prints these bytes.
std::string saying(const TemporaryFolder& folder, const std::string& bytes) {
  return "cat " + makeFile(folder, "said", bytes);
}

std::string codeOf(const Inspection& said) { return Json::parse(said.json)["code"]; }
std::string detailOf(const Inspection& said) { return Json::parse(said.json)["detail"]; }

}  // namespace

TEST_CASE("what the process says comes back as it is", "[threads]") {
  const TemporaryFolder files;
  Bench bench(saying(files, framed(kValid, smallPreview())));
  Inspection said = bench.judge();
  CHECK(said.status == 200);
  CHECK(said.json == kValid);
  CHECK(said.preview == smallPreview());
  CHECK(said.valid);
  makeFile(files, "said", framed(R"({"valid":false,"measures":{}})"));
  said = bench.judge();
  CHECK(said.status == 200);
  CHECK_FALSE(said.valid);
  CHECK(said.preview.empty());
  const std::string problem = R"({"type":"about:blank","title":"Unprocessable Entity","status":422,"code":"bad_input",)"
                              R"("detail":"at line 3","line":3})";
  makeFile(files, "said", framed(problem));
  said = bench.judge();
  CHECK(said.status == 422);
  CHECK(said.json == problem);
  const InspectorCounts counts = bench.inspector->counts();
  CHECK(counts.valid == 1);
  CHECK(counts.invalid == 1);
  CHECK(counts.refused == 1);
  CHECK(counts.failed == 0);
  CHECK(counts.running == 0);
  CHECK(counts.seconds[15] == 3);
  CHECK(std::ranges::is_sorted(counts.seconds));
  CHECK(counts.seconds_sum > 0);
}

TEST_CASE("the process is told what it is to do", "[threads]") {
  InspectorSettings settings;
  settings.memory = uint64_t{100} << 20;
  settings.time = std::chrono::seconds(9);
  settings.masters = "some where/base.db";
  const TemporaryFolder files;
  const std::string seen = (files.path / "seen").string();
  Bench bench("{ for a in \"$@\"; do echo \"$a\"; done; cat; } >" + seen, settings);
  CHECK(bench.judge().status == 500);
  CHECK(contentOf(seen) ==
        "inspect\n--kind=obj\n--name=name 1.obj\n--region=0,0,0:1,1,1\n--set=a=b\n--memory=100\n--seconds=9\n"
        "--masters=some where/base.db\ncontent");
}

TEST_CASE("whatever end the process comes to, there is an answer", "[threads]") {
  const TemporaryFolder files;
  const std::string big = makeFile(files, "big", std::string(size_t{33} << 20, 'x'));
  int made = 0;
  const auto said = [&](const std::string& bytes) {
    return "cat " + makeFile(files, "odd" + std::to_string(++made), bytes);
  };
  struct Case {
    std::string lines, code, detail;
  };
  const std::vector<Case> cases{
      {"kill -SEGV $$", "validator_crashed", "signal 11"},
      {"kill -KILL $$", "validator_crashed", "memory"},
      {"kill -XCPU $$", "validator_limit", "processor time"},
      {"echo 'why it was' >&2; exit 3", "validator_crashed", "status 3: why it was"},
      {":", "validator_crashed", "without an answer"},
      {"sleep 1000", "validator_limit", "1 s"},
      {"trap '' TERM; sleep 1000; sleep 1000", "validator_limit", "1 s"},
      {"cat " + big, "validator_limit", "32 MB"},
      {"yes", "validator_limit", "32 MB"},
      {said(framed(R"({"valid":true,"measures":{"a":")" + std::string(size_t{2} << 20, 'x') + "\"}}")),
       "validator_limit", "2 MB"},
      {"echo garbage that is long enough", "validator_crashed", "something other"},
      {said(framed(kValid).substr(0, 30)), "validator_crashed", "something other"},
  };
  for (const Case& c : cases) {
    INFO(c.lines);
    InspectorSettings settings;
    if (c.detail == "1 s") settings.time = std::chrono::seconds(1);
    Bench bench(c.lines, settings);
    const Inspection answer = bench.judge();
    CHECK(answer.status == 500);
    CHECK(codeOf(answer) == c.code);
    CHECK(detailOf(answer).find(c.detail) != std::string::npos);
    CHECK(bench.inspector->counts().failed == 1);
  }
}

TEST_CASE("what is no report is not taken for one", "[threads]") {
  const TemporaryFolder files;
  Bench bench("cat " + makeFile(files, "said", ""));
  const std::string deep =
      R"({"valid":true,"measures":{"a":)" + std::string(100'000, '[') + std::string(100'000, ']') + "}}";
  std::string huge_part = framed(kValid);
  for (size_t i = 0; i < 8; ++i) huge_part[i] = '\xFF';
  for (const std::string& odd :
       {framed("[]"), framed("{}"), framed(R"({"valid":1,"measures":{}})"), framed(R"({"valid":true})"),
        framed(R"({"status":200})"), framed(R"({"status":"422","code":"x","detail":"y","type":"","title":""})"),
        framed(R"({"status":503,"code":"x","detail":"y","type":"","title":""})"), framed(R"({"status":422})"),
        framed(R"({"valid":true,"measures":{},"status":422})"), framed(R"({"valid":true,"valid":false,"measures":{}})"),
        framed(R"({"v\u0061lid":true,"valid":false,"measures":{}})"), framed(deep), framed(kValid) + "x", huge_part,
        framed(kValid.substr(1)), framed(kValid, "SGMPREV1"), framed(kValid, smallPreview() + "x"),
        framed(kValid, smallPreview(3)), framed("{\"valid\":true,\"measures\":{\"a\":\"\xFF\"}}")}) {
    INFO(odd.substr(0, 80));
    makeFile(files, "said", odd);
    const Inspection answer = bench.judge();
    CHECK(answer.status == 500);
    CHECK(codeOf(answer) == "validator_crashed");
  }
  // The same inspector still works after these failures.
  makeFile(files, "said", framed(kValid));
  CHECK(bench.judge().status == 200);
}

TEST_CASE("where nobody is told how children end, their verdict counts", "[threads]") {
  const TemporaryFolder files;
  const auto handler = std::signal(SIGCHLD, SIG_IGN);
  {
    Bench bench(saying(files, framed(kValid)));
    CHECK(bench.judge().status == 200);
    makeFile(files, "said", "");
    CHECK(bench.judge().status == 500);
  }
  std::signal(SIGCHLD, handler);
}

TEST_CASE("a full queue takes no more, and loses nothing", "[threads]") {
  InspectorSettings settings;
  settings.jobs = 2;
  settings.waiting = 3;
  const TemporaryFolder files;
  const std::string gate = (files.path / "gate").string();
  Bench bench("while [ ! -e " + gate + " ]; do sleep 0.02; done\n" + saying(files, framed(kValid)), settings);
  for (int job = 0; job < 5; ++job) REQUIRE(bench.send(job));
  REQUIRE(bench.told.waitForBegun(2));
  CHECK(bench.inspector->counts().running == 2);
  CHECK(bench.inspector->counts().waiting == 3);
  const Result<void> refused = bench.send(5), would = bench.inspector->wouldTake();
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == Code::limit);
  REQUIRE_FALSE(would);
  CHECK(would.error().code == Code::limit);
  makeFile(files, "gate", "");
  REQUIRE(bench.told.waitForDone(5));
  CHECK(bench.inspector->wouldTake());
  std::vector<int> jobs;
  for (const auto& [job, said] : bench.told.allDone()) {
    jobs.push_back(job);
    CHECK(said.status == 200);
  }
  std::ranges::sort(jobs);
  CHECK(jobs == std::vector<int>{0, 1, 2, 3, 4});
  std::vector<int> begun = bench.told.allBegun();
  std::ranges::sort(begun);
  CHECK(begun == jobs);
}

TEST_CASE("ten uploads at once from ten threads are all answered", "[threads]") {
  InspectorSettings settings;
  settings.jobs = 4;
  settings.waiting = 10;
  const TemporaryFolder files;
  Bench bench(saying(files, framed(kValid)), settings);
  std::vector<std::thread> threads;
  std::atomic<int> taken = 0;
  for (int job = 0; job < 10; ++job)
    threads.emplace_back([&, job] {
      Result<Upload> upload = Upload::create(bench.folder.path.string());
      if (!upload) return;
      taken += static_cast<bool>(bench.inspector->inspect(
          std::move(*upload), [&, job] { bench.told.began(job); },
          [&, job](Inspection said) { bench.told.done(job, std::move(said)); }));
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(taken == 10);
  REQUIRE(bench.told.waitForDone(10));
  CHECK(bench.told.allDone().size() == 10);
  CHECK(bench.inspector->counts().valid == 10);
}

TEST_CASE("an inspector that ends tells all who wait, and leaves no process", "[threads]") {
  InspectorSettings settings;
  settings.jobs = 2;
  const TemporaryFolder files;
  Bench bench("echo $$ >>" + (files.path / "pids").string() + "\nexec sleep 1000", settings);
  for (int job = 0; job < 6; ++job) REQUIRE(bench.send(job));
  bench.inspector->readMasters([&](Inspection said) { bench.told.done(10, std::move(said)); });
  bench.inspector->readMasters([&](Inspection said) { bench.told.done(11, std::move(said)); });
  REQUIRE(bench.told.waitForBegun(2));
  const auto start = std::chrono::steady_clock::now();
  // Waits until two uploads and one request to read the reference histograms run.
  while (std::ranges::count(contentOf(files.path / "pids"), '\n') < 3 &&
         std::chrono::steady_clock::now() - start < std::chrono::seconds(30))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  bench.inspector.reset();
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(60));
  CHECK(bench.told.allBegun().size() == 2);
  REQUIRE(bench.told.allDone().size() == 8);
  for (const auto& [job, said] : bench.told.allDone()) {
    CHECK(said.status == 503);
    CHECK(codeOf(said) == "stopping");
  }
  std::istringstream pids(contentOf(files.path / "pids"));
  for (int process = 0; pids >> process;) CHECK_FALSE(runs(process));
}

TEST_CASE("without a program that runs nothing is taken", "[threads]") {
  const TemporaryFolder files;
  for (const std::string& program : {std::string(), makeFile(files, "plain", "x"), (files.path / "none").string()}) {
    InspectorSettings settings;
    settings.program = program;
    Result<std::unique_ptr<Inspector>> inspector = Inspector::create(settings);
    REQUIRE(inspector);
    const Result<void> takes = (*inspector)->wouldTake();
    REQUIRE_FALSE(takes);
    CHECK(takes.error().code == Code::unsupported);
    Result<Upload> upload = Upload::create("");
    REQUIRE(upload);
    const Result<void> taken = (*inspector)
                                   ->inspect(
                                       std::move(*upload), [] {}, [](Inspection) {});
    CHECK_FALSE(taken);
    Told told;
    (*inspector)->readMasters([&](Inspection said) { told.done(0, std::move(said)); });
    REQUIRE(told.waitForDone(1));
    CHECK(told.allDone()[0].second.status == (program.empty() ? 503 : 500));
  }
}

TEST_CASE("numbers out of range are refused") {
  std::vector<InspectorSettings> all(6);
  all[0].jobs = 0;
  all[1].jobs = 65;
  all[2].waiting = 4097;
  all[3].memory = 1000;
  all[4].time = std::chrono::seconds(0);
  all[5].time = std::chrono::seconds(86401);
  for (const InspectorSettings& settings : all) {
    const auto made = Inspector::create(settings);
    REQUIRE_FALSE(made);
    CHECK(made.error().code == Code::invalid_argument);
  }
}

TEST_CASE("masters are read and written by a process too", "[threads]") {
  const TemporaryFolder files;
  const std::string masters = R"({"from":"x","masters":[],"limits":[]})";
  const std::string seen = (files.path / "seen").string();
  InspectorSettings settings;
  Bench bench("{ echo $2; cat; } >" + seen + "\n" + saying(files, framed(masters)), settings);
  bench.inspector->readMasters([&](Inspection said) { bench.told.done(0, std::move(said)); });
  REQUIRE(bench.told.waitForDone(1));
  CHECK(bench.told.allDone()[0].second.status == 200);
  CHECK(bench.told.allDone()[0].second.json == masters);
  CHECK(contentOf(seen) == "--list-masters\n");
  // If the file of reference histograms does not exist, it is not created.
  bench.inspector->writeMasters("{}", [&](Inspection said) { bench.told.done(1, std::move(said)); });
  REQUIRE(bench.told.waitForDone(2));
  CHECK(bench.told.allDone()[1].second.status == 409);
  CHECK(codeOf(bench.told.allDone()[1].second) == "read_only");

  bench.settings.masters = "base.db";
  bench.restart();
  const std::string large(3'000'000, ' ');
  bench.inspector->writeMasters(large, [&](Inspection said) { bench.told.done(2, std::move(said)); });
  REQUIRE(bench.told.waitForDone(3));
  CHECK(bench.told.allDone()[2].second.status == 200);
  CHECK(contentOf(seen) == "--store-masters\n" + large);
  makeFile(files, "said",
           framed(R"({"type":"about:blank","title":"Bad Request","status":400,"code":"bad_json","detail":"x"})"));
  bench.inspector->writeMasters("{", [&](Inspection said) { bench.told.done(3, std::move(said)); });
  REQUIRE(bench.told.waitForDone(4));
  CHECK(bench.told.allDone()[3].second.status == 400);
  CHECK(bench.inspector->counts().refused == 0);
}

TEST_CASE("what masters have of the name valid is nobody's business", "[threads]") {
  const TemporaryFolder files;
  const std::string masters = R"({"valid":"text","masters":[],"limits":[]})";
  Bench bench(saying(files, framed(masters)));
  bench.inspector->readMasters([&](Inspection said) { bench.told.done(0, std::move(said)); });
  REQUIRE(bench.told.waitForDone(1));
  CHECK(bench.told.allDone()[0].second.status == 200);
  CHECK(bench.told.allDone()[0].second.json == masters);
  CHECK_FALSE(bench.told.allDone()[0].second.valid);
}

TEST_CASE("whatever those who are told throw, the inspector goes on", "[threads]") {
  const TemporaryFolder files;
  Bench bench(saying(files, framed(kValid)));
  Result<Upload> upload = Upload::create(bench.folder.path.string());
  REQUIRE(upload);
  REQUIRE(bench.inspector->inspect(
      std::move(*upload), [] { throw 1; },
      [&](Inspection said) {
        bench.told.done(0, std::move(said));
        throw 2;
      }));
  REQUIRE(bench.told.waitForDone(1));
  bench.inspector->readMasters([](const Inspection&) { throw 3; });
  CHECK(bench.judge().status == 200);
}

TEST_CASE("an upload ends where nobody waits for it", "[threads]") {
  const TemporaryFolder files;
  Bench bench(saying(files, framed(kValid)));
  // The callback owns `reply`, as a real callback owns an upload's file and a client's reply. So `reply` is destroyed
  // with the callback; its deleter checks that the inspector can be called at this time.
  const auto free = std::make_shared<std::atomic<bool>>(false);
  std::shared_ptr<int> reply(new int(0), [&, free](const int* number) {
    delete number;
    std::thread([&, free] {
      static_cast<void>(bench.inspector->counts());
      *free = true;
    }).detach();
    for (int i = 0; i < 500 && !*free; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    bench.told.done(static_cast<bool>(*free), {});
  });
  Result<Upload> upload = Upload::create(bench.folder.path.string());
  REQUIRE(upload);
  REQUIRE(bench.inspector->inspect(
      std::move(*upload), [] {}, [held = std::move(reply)](const Inspection&) {}));
  REQUIRE(bench.told.waitForDone(1));
  CHECK(bench.told.allDone()[0].first == 1);
}

TEST_CASE("the process may read the upload, and not write it", "[threads]") {
  const TemporaryFolder files;
  Bench bench("{ echo more >&0; } 2>/dev/null && exit 9\n[ \"$(cat)\" = content ] || exit 8\n" +
              saying(files, framed(kValid)));
  CHECK(bench.judge().status == 200);
}

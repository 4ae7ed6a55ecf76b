// Tests the report's folder: it is complete or unchanged, and no files of the user are lost.

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include "catch.h"
#include "rounds.h"
#include "temporary_folder.h"
#include "tools/paper/bundle.h"
#include "tools/paper/folder.h"
#include "tools/support/ending_signals.h"

using namespace sgm;
using namespace sgm::cli;
namespace fs = std::filesystem;

namespace {

void write(const fs::path& file, const std::string& content) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << content;
}

std::vector<FolderFile> report(const std::string& page) { return {{kReportPage, page}, {"pictures/a.png", page}}; }

/// Number of entries in a folder.
size_t entriesOf(const fs::path& folder) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

constinit EndingSignals signals;

void endBy(int signal) {
  if (signals.waits(signal)) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Writes reports over each other until the process is killed, while other threads receive signals.
[[noreturn]] void replaceForever(const fs::path& target) {
  std::signal(SIGTERM, endBy);
  const auto idle = [] {
    for (;;) pause();
  };
  const std::thread one(idle), another(idle);
  for (char c = 'a';; c = c == 'z' ? 'a' : static_cast<char>(c + 1))
    if (!writeReportFolder(target, report(std::string(1, c)), &signals)) _exit(1);
}

}  // namespace

TEST_CASE("a report takes the place of nothing, of an empty folder and of an earlier report") {
  const TemporaryFolder folder;
  const fs::path target = folder.path / "report";
  REQUIRE(checkReportFolder(target));
  CHECK(entriesOf(folder.path) == 0);
  REQUIRE(writeReportFolder(target, report("one")));
  CHECK(contentOf(target / kReportPage) == "one");
  CHECK(contentOf(target / "pictures/a.png") == "one");
  REQUIRE(checkReportFolder(target));
  REQUIRE(writeReportFolder(target / "", {{kReportPage, "two"}}));
  CHECK(contentOf(target / kReportPage) == "two");
  CHECK_FALSE(fs::exists(target / "pictures"));
  fs::remove_all(target);
  fs::create_directory(target);
  REQUIRE(writeReportFolder(target, report("three")));
  CHECK(entriesOf(folder.path) == 1);
}

TEST_CASE("what is no report stays as it was") {
  const TemporaryFolder folder;
  const fs::path target = folder.path / "target";
  const auto refused = [&] {
    for (const Result<void>& result : {checkReportFolder(target), writeReportFolder(target, report("new"))}) {
      CHECK_FALSE(result);
      if (!result) CHECK(result.error().code == Code::io);
    }
  };
  write(target, "a file");
  refused();
  CHECK(contentOf(target) == "a file");
  fs::remove(target);
  write(target / "mine.txt", "mine");
  refused();
  CHECK(contentOf(target / "mine.txt") == "mine");
  fs::remove_all(target);
  REQUIRE(writeReportFolder(target, report("old")));
  for (const char* mine : {"mine.txt", "pictures/mine.txt", "grammars/mine.sgm", "pictures/deep/er/mine"}) {
    CAPTURE(mine);
    write(target / mine, "mine");
    refused();
    CHECK(contentOf(target / mine) == "mine");
    fs::remove(target / mine);
    while (fs::remove(target / "pictures/deep/er") || fs::remove(target / "pictures/deep")) {
    }
    fs::remove(target / "grammars");
  }
  CHECK(checkReportFolder(target));
  // Edits by the user, which must prevent the folder from being replaced: a file of unchanged size, a link to the same
  // bytes, and an empty folder.
  write(target / "pictures/a.png", "OLD");
  refused();
  CHECK(contentOf(target / "pictures/a.png") == "OLD");
  write(folder.path / "elsewhere", "old");
  fs::remove(target / "pictures/a.png");
  fs::create_symlink(folder.path / "elsewhere", target / "pictures/a.png");
  refused();
  fs::remove(target / "pictures/a.png");
  fs::remove(folder.path / "elsewhere");
  CHECK(checkReportFolder(target));
  fs::create_directory(target / "mine");
  refused();
  fs::remove(target / "mine");
  // A folder without a manifest, or with another one, was not written by us, and is not replaced.
  write(target / kReportManifest, "mine");
  refused();
  fs::remove(target / kReportManifest);
  refused();
  CHECK(contentOf(target / kReportPage) == "old");
  CHECK(entriesOf(folder.path) == 1);
}

TEST_CASE("a signal at any time leaves a whole report and nothing else") {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> wait(0, 20'000);
  for (unsigned i = 0; i < rounds(40); ++i) {
    CAPTURE(i);
    const TemporaryFolder folder;
    const fs::path target = folder.path / "report";
    REQUIRE(writeReportFolder(target, report("old")));
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) replaceForever(target);
    while (contentOf(target / kReportPage) == "old") std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::microseconds(wait(random)));
    REQUIRE(kill(child, SIGTERM) == 0);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK((WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM));
    CHECK(contentOf(target / kReportPage) == contentOf(target / "pictures/a.png"));
    CHECK(checkReportFolder(target));
    CHECK(entriesOf(folder.path) == 1);
  }
}

TEST_CASE("what cannot be written leaves nothing behind") {
  const TemporaryFolder folder;
  CHECK_FALSE(checkReportFolder(folder.path / "missing" / "report"));
  const fs::path target = folder.path / "report";
  REQUIRE(writeReportFolder(target, report("old")));
  // A file in the list has the name of a folder that another file needs.
  CHECK_FALSE(writeReportFolder(target, {{"pictures", "a file"}, {"pictures/a.png", "b"}}));
  CHECK(contentOf(target / kReportPage) == "old");
  CHECK(entriesOf(folder.path) == 1);
}

TEST_CASE("every bundled grammar compiles") {
  CHECK(bundledFiles().size() == 21);
  for (const BundledFile& file : bundledFiles()) {
    CAPTURE(std::string(file.path));
    CHECK(bundled(file.path) == &file);
    if (file.path.ends_with(".sgm")) CHECK(compileBundled(file.path).program != nullptr);
  }
  CHECK(bundled("nothing.sgm") == nullptr);
}

// The report's folder: whole or not at all, and nobody's files are lost.

#include <filesystem>
#include <fstream>
#include <iterator>

#include "catch.h"
#include "cli/paper/bundle.h"
#include "cli/paper/folder.h"
#include "temporary_folder.h"

using namespace sgm;
using namespace sgm::cli;
namespace fs = std::filesystem;

namespace {

void write(const fs::path& file, const std::string& content) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << content;
}

std::vector<FolderFile> report(const std::string& page) {
  return {{kReportPage, kReportSign + page}, {"pictures/a.png", page}};
}

/// What stands beside each other in a folder.
size_t entriesOf(const fs::path& folder) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("a report takes the place of nothing, of an empty folder and of an earlier report") {
  const TemporaryFolder folder;
  const fs::path target = folder.path / "report";
  REQUIRE(checkReportFolder(target));
  CHECK(entriesOf(folder.path) == 0);
  REQUIRE(writeReportFolder(target, report("one")));
  CHECK(contentOf(target / kReportPage) == kReportSign + std::string("one"));
  CHECK(contentOf(target / "pictures/a.png") == "one");
  REQUIRE(checkReportFolder(target));
  REQUIRE(writeReportFolder(target / "", {{kReportPage, kReportSign + std::string("two")}}));
  CHECK(contentOf(target / kReportPage) == kReportSign + std::string("two"));
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
  write(target / "mine.txt", "mine");
  refused();
  CHECK(contentOf(target / "mine.txt") == "mine");
  fs::remove_all(target);
  write(target / kReportPage, "<html>another page</html>");
  refused();
  CHECK(entriesOf(folder.path) == 1);
}

TEST_CASE("what cannot be written leaves nothing behind") {
  const TemporaryFolder folder;
  CHECK_FALSE(checkReportFolder(folder.path / "missing" / "report"));
  const fs::path target = folder.path / "report";
  REQUIRE(writeReportFolder(target, report("old")));
  // A file that stands where a folder is wanted.
  CHECK_FALSE(writeReportFolder(target, {{"pictures", "a file"}, {"pictures/a.png", "b"}}));
  CHECK(contentOf(target / kReportPage) == kReportSign + std::string("old"));
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

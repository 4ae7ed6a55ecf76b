// Tests the interface to the system's files: the effect of each call is checked by other calls.

#include "base/platform/file.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "catch.h"
#include "temporary_folder.h"

using namespace sgm;
using namespace sgm::platform;
namespace fs = std::filesystem;

namespace {

constexpr unsigned kNew = kRead | kWrite | kCreate | kExclusive;

File fileWith(const fs::path& path, const std::string& content) {
  File file(openFile(path, kNew));
  REQUIRE(file);
  REQUIRE(writeNext(file.number(), content.data(), content.size()) == static_cast<ptrdiff_t>(content.size()));
  return file;
}

}  // namespace

TEST_CASE("a file is opened as its flags say", "[base][files]") {
  const TemporaryFolder folder;
  const fs::path path = folder.path / "f\xC3\xBC \xE7\x8C\xAB";
  CHECK(openFile(path, kRead) == -1);
  CHECK(errno == ENOENT);
  { const File created = fileWith(path, "abc"); }
  CHECK(openFile(path, kNew) == -1);
  CHECK(errno == EEXIST);
  CHECK(contentOf(path) == "abc");
  const File again(openFile(path, kRead | kWrite | kCreate));
  REQUIRE(again);
  FileStatus status;
  REQUIRE(statusOf(again.number(), status) == 0);
  CHECK(status.isRegular());
  CHECK(status.bytes == 3);
  const File reading(openFile(path, kRead));
  CHECK(writeNext(reading.number(), "x", 1) == -1);
  CHECK(errno == EBADF);
}

TEST_CASE("links are followed or refused", "[base][files]") {
  const TemporaryFolder folder;
  const fs::path path = folder.path / "file", link = folder.path / "link";
  { const File created = fileWith(path, "abc"); }
  fs::create_symlink(path, link);
  CHECK(File(openFile(link, kRead)));
  CHECK(openFile(link, kRead | kNoFollow) == -1);
  CHECK(errno == ELOOP);
  FileStatus itself, target, file;
  REQUIRE(statusAt(link, itself, false) == 0);
  REQUIRE(statusAt(link, target, true) == 0);
  REQUIRE(statusAt(path, file, false) == 0);
  CHECK(itself.kind == FileStatus::Kind::link);
  CHECK(target.isSameFile(file));
  CHECK_FALSE(itself.isSameFile(file));
  REQUIRE(statusAt(folder.path, file, true) == 0);
  CHECK(file.kind == FileStatus::Kind::folder);
}

TEST_CASE("bytes are read and written at places, and cut off", "[base][files]") {
  const TemporaryFolder folder;
  const fs::path path = folder.path / "file";
  const File file = fileWith(path, "0123456789");
  CHECK(writeAt(file.number(), "ab", 2, 4) == 2);
  CHECK(contentOf(path) == "0123ab6789");
  char two[2];
  CHECK(readAt(file.number(), two, 2, 5) == 2);
  CHECK(std::memcmp(two, "b6", 2) == 0);
  CHECK(readNext(file.number(), two, 2) == 0);  // at the end of the file: readAt() did not move the position
  CHECK(readAt(file.number(), two, 2, 100) == 0);
  CHECK(cutFile(file.number(), 3) == 0);
  CHECK(contentOf(path) == "012");
  CHECK(syncFile(file.number()) == 0);
  CHECK(syncContent(file.number()) == 0);
  CHECK(syncFolder(folder.path) == 0);
}

TEST_CASE("a lock keeps out another opening until it is closed, and no reader", "[base][files]") {
  const TemporaryFolder folder;
  const fs::path path = folder.path / "file";
  File first = fileWith(path, "abc");
  const File second(openFile(path, kRead | kWrite));
  REQUIRE(lockFile(first.number()) == 0);
  CHECK(lockFile(second.number()) == -1);
  CHECK(errno == EWOULDBLOCK);
  CHECK(contentOf(path) == "abc");
  first = File();
  CHECK(lockFile(second.number()) == 0);
}

TEST_CASE("names are replaced, exchanged, removed and given", "[base][files]") {
  const TemporaryFolder folder;
  const fs::path a = folder.path / "a", b = folder.path / "b";
  { const File one = fileWith(a, "one"), two = fileWith(b, "two"); }
  if (exchangeFiles(a, b) == 0) {
    CHECK(contentOf(a) == "two");
    CHECK(contentOf(b) == "one");
    REQUIRE(exchangeFiles(a, b) == 0);
  }
  CHECK(replaceFile(a, b) == 0);
  CHECK(contentOf(b) == "one");
  CHECK_FALSE(fs::exists(a));
  CHECK(removeFile(a) == -1);
  CHECK(errno == ENOENT);
  removeFileInHandler(b.string().c_str());
  CHECK_FALSE(fs::exists(b));

  const File nameless(openNamelessFile(folder.path));
  if (!nameless) return;  // the file system does not support nameless files
  REQUIRE(writeNext(nameless.number(), "none", 4) == 4);
  CHECK(fs::is_empty(folder.path));
  REQUIRE(nameFile(nameless.number(), a) == 0);
  CHECK(contentOf(a) == "none");
  CHECK(nameFile(nameless.number(), a) == -1);
  CHECK(errno == EEXIST);
}

TEST_CASE("rights and times are those that were asked for", "[base][files]") {
  const TemporaryFolder folder;
  const fs::path a = folder.path / "a", b = folder.path / "b";
  const File one = fileWith(a, "one"), two = fileWith(b, "two");
  fs::permissions(a, fs::perms::owner_read | fs::perms::group_read);
  REQUIRE(takeRights(two.number(), a) == 0);
  CHECK(fs::status(b).permissions() == (fs::perms::owner_read | fs::perms::group_read));
  fs::last_write_time(b, fs::file_time_type::clock::now() - std::chrono::hours(1000));
  FileStatus before, after;
  REQUIRE(statusAt(b, before, true) == 0);
  REQUIRE(touchFile(b) == 0);
  REQUIRE(statusAt(b, after, true) == 0);
  CHECK(after.changed_ns - before.changed_ns > int64_t{999} * 3'600'000'000'000);
  CHECK(makeFolder(folder.path / "sub") == 0);
  CHECK(makeFolder(folder.path / "sub") == -1);
  CHECK(errno == EEXIST);
}

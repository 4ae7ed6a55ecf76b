// Tests reading whole files: the result is the contents, or an error with the reason.

#include "base/file_reader.h"

#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <random>
#include <thread>

#include "../programs.h"
#include "../rounds.h"
#include "../seed.h"
#include "base/platform/file.h"

using namespace sgm;
namespace fs = std::filesystem;

namespace {

std::string refusal(const Result<std::string>& read, Code code = Code::io) {
  REQUIRE_FALSE(read);
  CHECK(read.error().code == code);
  return read.error().message;
}

}  // namespace

TEST_CASE("files of any size are read whole, up to the limit", "[base][files]") {
  const TemporaryFolder folder;
  std::mt19937 random(testSeed());
  std::vector<size_t> sizes{0, 1, 65535, 65536, 65537};
  for (unsigned round = 0; round < rounds(10); ++round) sizes.push_back(random() % 1'000'000);
  for (const size_t size : sizes) {
    std::string bytes(size, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    const std::string path = makeFile(folder, "f\xC3\xBC \xE7\x8C\xAB", bytes);
    const Result<std::string> read = readFile(path, size);
    REQUIRE(read);
    CHECK((*read == bytes));
    const size_t part = size == 0 ? 7 : random() % (2 * size);
    const Result<std::string> beginning = readBeginning(path, part);
    REQUIRE(beginning);
    CHECK((*beginning == bytes.substr(0, part)));
    if (size == 0) continue;
    CHECK(refusal(readFile(path, size - 1), Code::limit) ==
          path + " is larger than " + std::to_string(size - 1) + " bytes");
  }
}

TEST_CASE("a file that cannot be read is told with the reason", "[base][files]") {
  const TemporaryFolder folder;
  const std::string path = makeFile(folder, "file", "text"), none = (folder.path / "none").string();
  CHECK(refusal(readFile(none, 10)) == "cannot read " + none + ": no such file");
  CHECK(refusal(readBeginning(none, 10)) == "cannot read " + none + ": no such file");
  CHECK(refusal(readFile(path + "/file", 10)) == "cannot read " + path + "/file: no such file");
  const std::string parent = folder.path.string();
  CHECK(refusal(readFile(parent, 10)) == "cannot read " + parent + ": it is not a regular file");
  CHECK(refusal(readFile(parent, 10, Readable::all_but_folders)) == "cannot read " + parent + ": it is a folder");
  const fs::path loop = folder.path / "loop";
  fs::create_symlink(loop, loop);
  CHECK(refusal(readFile(loop, 10)) == "cannot read " + loop.string() + ": Too many levels of symbolic links");
  if (geteuid() != 0) {
    fs::permissions(path, fs::perms::none);
    CHECK(refusal(readFile(path, 10)) == "cannot read " + path + ": Permission denied");
  }
  CHECK(refusal(readOpenFile(-1, "the file", 10)) == "cannot read the file: Bad file descriptor");
}

TEST_CASE("pipes are refused, or read to their end", "[base][files]") {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(refusal(readFile(pipe, 100)) == "cannot read " + pipe.string() + ": it is not a regular file");
  for (const unsigned size : {0u, 3u, 1'000'000u}) {
    const std::string bytes(size, 'x');
    std::thread writes([&] {
      std::ofstream out(pipe, std::ios::binary);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      out << bytes;
    });
    const Result<std::string> read = readFile(pipe, size, Readable::all_but_folders);
    writes.join();
    REQUIRE(read);
    CHECK((*read == bytes));
  }
  // Reading stops at the limit; /dev/zero never ends.
  CHECK(refusal(readFile("/dev/zero", 100'000, Readable::all_but_folders), Code::limit) ==
        "/dev/zero is larger than 100000 bytes");
}

TEST_CASE("an open file is read from its position, and files without a size to their end", "[base][files]") {
  const TemporaryFolder folder;
  const platform::File file(platform::openFile(makeFile(folder, "file", "0123456789"), platform::kRead));
  char three[3];
  REQUIRE(platform::readNext(file.number(), three, 3) == 3);
  CHECK(*readOpenFile(file.number(), "file", 10) == "3456789");
  CHECK(readOpenFile(file.number(), "file", 10)->empty());
  const Result<std::string> status = readFile("/proc/self/status", 1 << 20);
  REQUIRE(status);
  CHECK(status->starts_with("Name:"));
}

// Tests that files appear completely or not at all, whatever exists at the target and whichever process is killed
// meanwhile.

#include "base/file_writer.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <optional>

#include "catch.h"
#include "temporary_folder.h"

using namespace sgm;
namespace fs = std::filesystem;

namespace {

struct Folder : TemporaryFolder {
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(path)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }
};

unsigned modeOf(const fs::path& path) {
  struct stat there {};
  REQUIRE(stat(path.c_str(), &there) == 0);
  return there.st_mode & 07777;
}

constinit UnfinishedFiles unfinished;  // global, because a signal handler uses it

constexpr FileWriter::Naming kBoth[] = {FileWriter::Naming::nameless, FileWriter::Naming::named};

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("a file appears on commit, and not without", "[base][files]") {
  for (const FileWriter::Naming naming : kBoth) {
    const Folder folder;
    const fs::path target = folder.path / "file";
    for (const std::string& content : {std::string("one"), std::string(3 << 20, 'x'), std::string()}) {
      Result<FileWriter> file = FileWriter::create(target, nullptr, naming);
      REQUIRE(file);
      file->write(content);
      REQUIRE(file->commit());
      CHECK((contentOf(target) == content));
      CHECK(file->bytes() == content.size());
      CHECK(folder.files() == Names{"file"});
    }
    std::ofstream(target) << "before";
    for (const bool finished : {false, true}) {
      Result<FileWriter> file = FileWriter::create(target, nullptr, naming);
      REQUIRE(file);
      file->write("after");
      if (finished) REQUIRE(file->finish());
    }
    CHECK(contentOf(target) == "before");
    CHECK(folder.files() == Names{"file"});
  }
}

TEST_CASE("what is replaced keeps its mode, and links stay links", "[base][files]") {
  for (const FileWriter::Naming naming : kBoth) {
    const Folder folder;
    fs::create_directory(folder.path / "inner");
    const fs::path real = folder.path / "inner" / "real", link = folder.path / "link", far = folder.path / "far";
    std::ofstream(real) << "before";
    REQUIRE(chmod(real.c_str(), 0640) == 0);
    fs::create_symlink("inner/real", link);
    fs::create_symlink(link, far);
    fs::create_symlink("inner/later", folder.path / "dangling");
    for (const char* name : {"far", "dangling"}) {
      Result<FileWriter> file = FileWriter::create(folder.path / name, nullptr, naming);
      REQUIRE(file);
      file->write("after");
      REQUIRE(file->commit());
      CHECK(fs::is_symlink(folder.path / name));
      CHECK(contentOf(folder.path / name) == "after");
    }
    CHECK(fs::is_symlink(link));
    CHECK(contentOf(real) == "after");
    CHECK(modeOf(real) == 0640);
    const mode_t mask = umask(0);
    umask(mask);
    CHECK(modeOf(folder.path / "inner" / "later") == (0666 & ~mask));
    CHECK(folder.files() == Names{"dangling", "far", "inner", "link"});
  }
}

TEST_CASE("what cannot be written to is said at once", "[base][files]") {
  const Folder folder;
  const auto refused = [&](const fs::path& target, const std::string& why) {
    const Result<FileWriter> file = FileWriter::create(target);
    INFO(target << " " << why);
    REQUIRE(!file);
    CHECK(file.error().code == Code::io);
    CHECK(file.error().message.find(target.string()) != std::string::npos);
    CHECK(file.error().message.find(why) != std::string::npos);
  };
  fs::create_symlink("round", folder.path / "round");
  refused(folder.path / "round", "");
  fs::remove(folder.path / "round");
  refused(folder.path / "missing" / "file", "No such file");
  refused(folder.path / std::string(300, 'n'), "too long");
  refused(folder.path, "folder");
  refused("/dev/null", "regular file");
  CHECK(folder.files().empty());
  // A name of the greatest allowed length, to which the temporary file's suffix cannot be added.
  Result<FileWriter> file = FileWriter::create(folder.path / std::string(255, 'n'));
  REQUIRE(file);
  REQUIRE(file->commit());
  if (geteuid() == 0) return;  // the superuser may write everywhere, so the test would fail
  std::ofstream(folder.path / "guarded") << "before";
  REQUIRE(chmod((folder.path / "guarded").c_str(), 0444) == 0);
  refused(folder.path / "guarded", "Permission denied");
  REQUIRE(chmod(folder.path.c_str(), 0500) == 0);
  refused(folder.path / "file", "Permission denied");
  REQUIRE(chmod(folder.path.c_str(), 0700) == 0);
}

TEST_CASE("a disk that is full at any moment leaves what was there", "[base][files]") {
  // A limit on the file size makes the write fail as a full disk does.
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const FileWriter::Naming naming : kBoth) {
    const Folder folder;
    const fs::path target = folder.path / "file";
    std::ofstream(target) << "before";
    for (const rlim_t limit : {rlim_t{0}, rlim_t{1000}, rlim_t{1} << 20}) {
      rlimit small = before;
      small.rlim_cur = limit;
      std::optional<Error> error;
      REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
      {
        Result<FileWriter> file = FileWriter::create(target, nullptr, naming);
        if (file) {
          for (int i = 0; i < 3000; ++i) file->write(std::string(1000, 'x'));
          if (const Result<void> done = file->commit(); !done) error = done.error();
        }
      }
      REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
      REQUIRE(error);
      CHECK(error->code == Code::io);
      CHECK(error->message.find("file") != std::string::npos);
      CHECK(contentOf(target) == "before");
      CHECK(folder.files() == Names{"file"});
    }
  }
  std::signal(SIGXFSZ, old_handler);
}

TEST_CASE("a commit can be taken back", "[base][files]") {
  for (const FileWriter::Naming naming : kBoth) {
    const Folder folder;
    const fs::path target = folder.path / "file";
    std::ofstream(target) << "before";
    for (const bool existed : {true, false}) {
      if (!existed) fs::remove(target);
      {
        Result<FileWriter> file = FileWriter::create(target, nullptr, naming);
        REQUIRE(file);
        file->write("after");
        REQUIRE(file->commitReversibly());
        CHECK(contentOf(target) == "after");
        file->undo();
      }
      CHECK(contentOf(target) == (existed ? "before" : ""));
      CHECK(folder.files() == (existed ? Names{"file"} : Names{}));
    }
    {
      Result<FileWriter> file = FileWriter::create(target, nullptr, naming);
      REQUIRE(file);
      REQUIRE(file->commitReversibly());
    }
    CHECK(folder.files() == Names{"file"});
  }
}

TEST_CASE("a process that a signal ends leaves no unfinished file, and what a killed one leaves goes with the next",
          "[base][files]") {
  const Folder folder;
  const fs::path target = folder.path / "file";
  for (const int signal : {SIGTERM, SIGKILL}) {
    int ready[2];
    REQUIRE(pipe(ready) == 0);
    const pid_t child = fork();
    if (child == 0) {
      std::signal(SIGTERM, [](int) {
        unfinished.remove();
        _exit(7);
      });
      Result<FileWriter> file = FileWriter::create(target, &unfinished, FileWriter::Naming::named);
      if (file) file->write("half");
      [[maybe_unused]] const ssize_t told = ::write(ready[1], file ? "y" : "n", 1);
      for (;;) pause();
    }
    char opened = 0;
    REQUIRE(read(ready[0], &opened, 1) == 1);
    CHECK(opened == 'y');
    close(ready[0]);
    close(ready[1]);
    CHECK(folder.files() == Names{"file.sgm-part0"});
    {
      // While the writer exists, no other writer can take its temporary file.
      Result<FileWriter> other = FileWriter::create(target, nullptr, FileWriter::Naming::named);
      REQUIRE(other);
      CHECK(folder.files() == Names{"file.sgm-part0", "file.sgm-part1"});
    }
    REQUIRE(kill(child, signal) == 0);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(folder.files() == (signal == SIGTERM ? Names{} : Names{"file.sgm-part0"}));
  }
  for (const FileWriter::Naming naming : kBoth) {
    for (const char* name : {"file.sgm-part0", "file.sgm-part1"})
      std::ofstream(folder.path / name) << "half of a killed process's";
    Result<FileWriter> file = FileWriter::create(target, nullptr, naming);
    REQUIRE(file);
    REQUIRE(file->commit());
    CHECK(folder.files() == Names{"file"});
  }
}

#include "cli/paper/folder.h"

#include <fmt/core.h>
#include <signal.h>
#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "base/file_writer.h"

namespace sgm::cli {
namespace {

namespace fs = std::filesystem;

Error failure(const fs::path& path, const std::string& why) {
  return Error{Code::io, fmt::format("cannot write {}: {}", path.string(), why)};
}

/// While it lives, signals that end a process wait.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM}) sigaddset(&set, signal);
    pthread_sigmask(SIG_BLOCK, &set, &before_);
  }
  ~SignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

 private:
  sigset_t before_{};
};

/// A new folder beside the target, removed with all that is in it unless it got another name.
class Beside {
 public:
  static Result<Beside> create(const fs::path& target) {
    std::string name = target.string() + ".sgm-partXXXXXX";
    if (mkdtemp(name.data()) == nullptr) return failure(target, std::strerror(errno));
    return Beside(std::move(name));
  }
  Beside(Beside&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  Beside& operator=(Beside&&) = delete;
  ~Beside() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }
  void keep() { path_.clear(); }

 private:
  explicit Beside(std::string path) : path_(std::move(path)) {}
  fs::path path_;
};

/// Without a slash at its end, which would be a name of its own.
fs::path cleaned(const fs::path& target) {
  const fs::path path = target.lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

bool isReport(const fs::path& folder) {
  std::ifstream page(folder / kReportPage, std::ios::binary);
  std::string head(4096, '\0');
  page.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find(kReportSign) != std::string::npos;
}

/// Nothing there, an empty folder, or an earlier report.
Result<void> checkTarget(const fs::path& target) {
  std::error_code why;
  const fs::file_status status = fs::symlink_status(target, why);
  if (status.type() == fs::file_type::not_found) return {};
  if (status.type() == fs::file_type::none) return failure(target, why.message());
  if (status.type() != fs::file_type::directory) return failure(target, "it is there, and no folder");
  fs::directory_iterator entries(target, why);
  if (why) return failure(target, why.message());
  if (entries == fs::directory_iterator()) return {};
  if (!isReport(target)) return failure(target, "the folder is not empty, and holds no earlier report");
  for (const fs::directory_entry& entry : entries) {
    const std::string name = entry.path().filename().string();
    const bool ours = name == kReportPage || std::ranges::find(kReportFolders, name) != std::end(kReportFolders);
    if (!ours) return failure(target, fmt::format("it holds {} beside an earlier report", name));
  }
  return {};
}

Result<void> writeFile(const fs::path& path, const std::string& bytes) {
  std::error_code why;
  fs::create_directories(path.parent_path(), why);
  if (why) return failure(path, why.message());
  Result<FileWriter> file = FileWriter::create(path);
  if (!file) return file.error();
  file->write(bytes);
  return file->commit();
}

/// The new folder takes the target's name.
Result<void> takePlace(Beside& made, const fs::path& target) {
  std::error_code why;
  fs::permissions(made.path(),
                  fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read |
                      fs::perms::others_exec,
                  why);
  if (why) return failure(target, why.message());
  // An empty folder is replaced by renaming alone.
  fs::rename(made.path(), target, why);
  if (!why) {
    made.keep();
    return {};
  }
  Result<Beside> old = Beside::create(target);
  if (!old) return old.error();
  const fs::path place = old->path() / "report";
  fs::rename(target, place, why);
  if (why) return failure(target, why.message());
  fs::rename(made.path(), target, why);
  if (why) {
    std::error_code ignored;
    fs::rename(place, target, ignored);
    return failure(target, why.message());
  }
  made.keep();
  return {};
}

}  // namespace

Result<void> checkReportFolder(const fs::path& given) {
  const SignalsWait wait;
  const fs::path target = cleaned(given);
  if (const Result<void> fits = checkTarget(target); !fits) return fits.error();
  const Result<Beside> possible = Beside::create(target);
  if (!possible) return possible.error();
  return {};
}

Result<void> writeReportFolder(const fs::path& given, const std::vector<FolderFile>& files) {
  const SignalsWait wait;
  const fs::path target = cleaned(given);
  if (const Result<void> fits = checkTarget(target); !fits) return fits.error();
  Result<Beside> made = Beside::create(target);
  if (!made) return made.error();
  for (const FolderFile& file : files) {
    const Result<void> written = writeFile(made->path() / file.path, file.bytes);
    if (!written) return failure(target, written.error().message);
  }
  return takePlace(*made, target);
}

}  // namespace sgm::cli

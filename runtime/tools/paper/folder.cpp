#include "tools/paper/folder.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <stdlib.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <sstream>
#include <system_error>
#include <utility>

#include "base/checksum.h"
#include "base/file_reader.h"
#include "base/file_writer.h"
#include "base/plain_text.h"

namespace sgm::cli {
namespace {

namespace fs = std::filesystem;

Error failure(const fs::path& path, const std::string& why) {
  return Error{Code::io, fmt::format("cannot write {}: {}", path.string(), why)};
}

/// A temporary folder beside the target. The destructor removes the folder with its contents, unless keep() was called
/// after renaming it to the target.
class Beside {
 public:
  static Result<Beside> create(const fs::path& target) {
    std::string name = target.string() + ".sgm-partXXXXXX";
    if (mkdtemp(name.data()) == nullptr) return failure(target, systemMessage(errno));
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

/// The normalized path without a trailing slash, since a path that ends with a slash has no file name.
fs::path cleaned(const fs::path& target) {
  const fs::path path = target.lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

std::optional<std::string> contentOf(const fs::path& path) {
  std::error_code why;
  if (!fs::is_regular_file(fs::symlink_status(path, why))) return std::nullopt;
  Result<std::string> bytes = readFile(path, UINT64_MAX);
  return bytes ? std::optional(std::move(*bytes)) : std::nullopt;
}

std::string sumOf(const std::string& bytes) {
  return fmt::format("{:016x}", checksum(std::as_bytes(std::span(bytes))));
}

FolderFile manifestOf(const std::vector<FolderFile>& files) {
  std::string lines = std::string(kReportSign) + "\n";
  for (const FolderFile& file : files) lines += fmt::format("{}  {}\n", sumOf(file.bytes), file.path);
  return {kReportManifest, std::move(lines)};
}

/// Reads the manifest of a report. Returns the checksums by path; nullopt if there is no valid manifest.
std::optional<std::map<std::string, std::string>> sumsOf(const fs::path& report) {
  const std::optional<std::string> manifest = contentOf(report / kReportManifest);
  if (!manifest) return std::nullopt;
  std::istringstream lines(*manifest);
  std::string line;
  if (!std::getline(lines, line) || line != kReportSign) return std::nullopt;
  std::map<std::string, std::string> sums;
  while (std::getline(lines, line)) {
    if (line.size() < 19) return std::nullopt;
    sums[line.substr(18)] = line.substr(0, 16);
  }
  return sums;
}

/// Checks that a folder is empty or an unchanged report, so that it may be removed. target: path for messages.
Result<void> checkReplaceable(const fs::path& folder, const fs::path& target) {
  std::error_code why;
  fs::recursive_directory_iterator entries(folder, why);
  if (why) return failure(target, systemMessage(why));
  if (entries == fs::recursive_directory_iterator()) return {};
  const std::optional<std::map<std::string, std::string>> sums = sumsOf(folder);
  if (!sums) return failure(target, "the folder is not empty and has no earlier report: name a new folder");
  for (; entries != fs::recursive_directory_iterator(); entries.increment(why)) {
    const std::string path = entries->path().lexically_relative(folder).generic_string();
    const fs::file_type type = entries->symlink_status(why).type();
    if (path == kReportManifest && type == fs::file_type::regular) continue;
    const auto listed = sums->lower_bound(type == fs::file_type::directory ? path + "/" : path);
    const bool known = listed != sums->end() &&
                       (type == fs::file_type::directory ? listed->first.starts_with(path + "/")
                                                         : type == fs::file_type::regular && listed->first == path);
    if (!known) return failure(target, fmt::format("it has {} beside an earlier report: move that file away", path));
    if (type == fs::file_type::directory) continue;
    const std::optional<std::string> bytes = contentOf(entries->path());
    if (!bytes || sumOf(*bytes) != listed->second)
      return failure(target, fmt::format("{} in it has changed since the report was made: move that file away", path));
  }
  if (why) return failure(target, systemMessage(why));
  return {};
}

Result<void> exchange(const fs::path& a, const fs::path& b, const fs::path& target) {
#ifdef RENAME_EXCHANGE
  if (renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return {};
#else
  errno = ENOSYS;
#endif
  const bool cannot = errno == EINVAL || errno == ENOSYS || errno == ENOTSUP;
  return failure(target, cannot ? "its file system cannot exchange folders: remove it first" : systemMessage(errno));
}

/// Checks the target. Returns true if it is a non-empty folder, which must be exchanged for the new report.
Result<bool> checkTarget(const fs::path& target) {
  std::error_code why;
  const fs::file_status status = fs::symlink_status(target, why);
  if (status.type() == fs::file_type::not_found) return false;
  if (status.type() == fs::file_type::none) return failure(target, systemMessage(why));
  if (status.type() != fs::file_type::directory) return failure(target, "it exists and is not a folder: name another");
  if (const Result<void> fits = checkReplaceable(target, target); !fits) return fits.error();
  const bool empty = fs::is_empty(target, why);
  if (why) return failure(target, systemMessage(why));
  return !empty;
}

Result<void> writeFile(const fs::path& path, const std::string& bytes) {
  std::error_code why;
  fs::create_directories(path.parent_path(), why);
  if (why) return failure(path, systemMessage(why));
  Result<FileWriter> file = FileWriter::create(path);
  if (!file) return file.error();
  file->write(bytes);
  return file->commit();
}

/// Moves the new folder to the target path.
Result<void> takePlace(Beside& made, const fs::path& target) {
  std::error_code why;
  fs::permissions(made.path(),
                  fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read |
                      fs::perms::others_exec,
                  why);
  if (why) return failure(target, systemMessage(why));
  // A rename succeeds if the target does not exist or is an empty folder; any other folder must be exchanged.
  fs::rename(made.path(), target, why);
  if (!why) {
    made.keep();
    return {};
  }
  if (const Result<void> exchanged = exchange(made.path(), target, target); !exchanged) return exchanged.error();
  // After the exchange, `made` is the old folder. It may have changed since the first check, so check again before it
  // is removed.
  const Result<void> replaceable = checkReplaceable(made.path(), target);
  if (!replaceable) {
    if (const Result<void> back = exchange(made.path(), target, target); !back) {
      const std::string place = made.path().string();
      made.keep();
      return failure(target, fmt::format("{}; its previous content is now {}", replaceable.error().message, place));
    }
  }
  return replaceable;
}

}  // namespace

Result<void> checkReportFolder(const fs::path& given, EndingSignals* signals) {
  const Uninterrupted whole(signals);
  const fs::path target = cleaned(given);
  const Result<bool> earlier = checkTarget(target);
  if (!earlier) return earlier.error();
  const Result<Beside> possible = Beside::create(target);
  if (!possible) return possible.error();
  if (!*earlier) return {};
  const Result<Beside> another = Beside::create(target);
  if (!another) return another.error();
  return exchange(possible->path(), another->path(), target);
}

Result<void> writeReportFolder(const fs::path& given, std::vector<FolderFile> files, EndingSignals* signals) {
  const Uninterrupted whole(signals);
  const fs::path target = cleaned(given);
  if (const Result<bool> fits = checkTarget(target); !fits) return fits.error();
  Result<Beside> made = Beside::create(target);
  if (!made) return made.error();
  files.push_back(manifestOf(files));
  for (const FolderFile& file : files) {
    const Result<void> written = writeFile(made->path() / file.path, file.bytes);
    if (!written) return failure(target, written.error().message);
  }
  return takePlace(*made, target);
}

}  // namespace sgm::cli

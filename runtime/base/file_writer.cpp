#include "base/file_writer.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include "base/plain_text.h"

namespace sgm {
namespace fs = std::filesystem;
namespace {

constexpr size_t kBufferBytes = size_t{1} << 20;
constexpr int kMostLinks = 40;
constexpr int kMostNames = 1000;

Error writeError(const fs::path& target, const std::string& reason) {
  return {Code::io, "cannot write '" + target.string() + "': " + reason};
}

Error writeError(const fs::path& target, int code) { return writeError(target, std::generic_category().message(code)); }

/// The path with links at its end followed, also to what is not there yet.
Result<std::string> followed(const fs::path& target) {
  fs::path place = target;
  for (int links = 0; links < kMostLinks; ++links) {
    std::error_code why;
    if (!fs::is_symlink(fs::symlink_status(place, why))) return place.string();
    const fs::path to = fs::read_symlink(place, why);
    if (why) return writeError(target, systemMessage(why));
    place = place.parent_path() / to;
  }
  return writeError(target, ELOOP);
}

std::string folderOf(const std::string& place) {
  const fs::path folder = fs::path(place).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// The name of an unfinished file, within the 255 bytes that file systems allow.
std::string nameBeside(const std::string& place, int number) {
  const fs::path path(place);
  return (path.parent_path() / path.filename().string().substr(0, 200)).string() + ".sgm-part" + std::to_string(number);
}

bool isAt(int file, const std::string& name) {
  struct stat ours {
  }, there{};
  return fstat(file, &ours) == 0 && lstat(name.c_str(), &there) == 0 && ours.st_ino == there.st_ino &&
         ours.st_dev == there.st_dev;
}

/// Whoever holds the lock of an unfinished file, and nobody else, may remove it: its writer, or after the writer's end
/// the first who gets it.
void removeIfLeft(const std::string& name) {
  const int file = ::open(name.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return;
  if (flock(file, LOCK_EX | LOCK_NB) == 0 && isAt(file, name)) unlink(name.c_str());
  ::close(file);
}

/// Those that killed processes left beside the target.
void removeLeft(const std::string& place) {
  for (int number = 0; number < kMostNames; ++number) {
    const std::string name = nameBeside(place, number);
    if (access(name.c_str(), F_OK) != 0) return;
    removeIfLeft(name);
  }
}

std::string linkOf(int file) { return "/proc/self/fd/" + std::to_string(file); }

int openNameless([[maybe_unused]] const std::string& folder) {
#ifdef O_TMPFILE
  const int file = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  // Its name will come through /proc, which not every container has.
  if (file < 0 || access(linkOf(file).c_str(), F_OK) == 0) return file;
  ::close(file);
#endif
  return -1;
}

}  // namespace

int UnfinishedFiles::announce(const std::string& name) {
  for (size_t i = 0; i < slots_.size() && name.size() < slots_[i].name.size(); ++i) {
    Slot& slot = slots_[i];
    int expected = Slot::open;
    if (!slot.state.compare_exchange_strong(expected, Slot::filling)) continue;
    std::memcpy(slot.name.data(), name.c_str(), name.size() + 1);
    slot.state = Slot::whole;
    return static_cast<int>(i);
  }
  return -1;
}

void UnfinishedFiles::remove() const noexcept {
  for (const Slot& slot : slots_)
    if (slot.state == Slot::whole) unlink(slot.name.data());
}

Result<FileWriter> FileWriter::create(const fs::path& target, UnfinishedFiles* unfinished, Naming naming) {
  const Result<std::string> place = followed(target);
  if (!place) return place.error();
  struct stat there {};
  const bool replaces = stat(place->c_str(), &there) == 0;
  if (!replaces && errno != ENOENT) return writeError(target, errno);
  if (replaces && S_ISDIR(there.st_mode)) return writeError(target, "it is a folder");
  if (replaces && !S_ISREG(there.st_mode)) return writeError(target, "it is no regular file");
  // The rename would not mind, but whoever protected the file does.
  if (replaces && access(place->c_str(), W_OK) != 0) return writeError(target, errno);

  removeLeft(*place);
  FileWriter writer(target, *place, naming == Naming::nameless ? openNameless(folderOf(*place)) : -1, unfinished);
  if (writer.file_ < 0) {
    if (const int code = writer.openNamed(); code != 0) return writeError(target, code);
  } else {
    flock(writer.file_, LOCK_EX | LOCK_NB);
  }
  if (replaces) {
    // An owner that we may not give keeps nothing but the mode.
    if ((there.st_uid != geteuid() || there.st_gid != getegid()) &&
        fchown(writer.file_, there.st_uid, there.st_gid) != 0)
      errno = 0;
    if (fchmod(writer.file_, there.st_mode & 0777) != 0) return writeError(target, errno);
  }
  return writer;
}

FileWriter::FileWriter(fs::path target, std::string place, int file, UnfinishedFiles* unfinished)
    : target_(std::move(target)), place_(std::move(place)), file_(file), unfinished_(unfinished) {
  buffer_.reserve(kBufferBytes);
}

FileWriter::FileWriter(FileWriter&& other) noexcept
    : target_(std::move(other.target_)),
      place_(std::move(other.place_)),
      temporary_(std::exchange(other.temporary_, {})),
      file_(std::exchange(other.file_, -1)),
      unfinished_(other.unfinished_),
      slot_(std::exchange(other.slot_, -1)),
      buffer_(std::move(other.buffer_)),
      bytes_(other.bytes_),
      first_error_(other.first_error_),
      undo_(other.undo_) {}

FileWriter::~FileWriter() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
  forgetName();
  close();
}

/// 0, or why there is no such file.
int FileWriter::openNamed() {
  for (int number = 0; number < kMostNames; ++number) {
    temporary_ = nameBeside(place_, number);
    file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file_ < 0 && errno == EEXIST) continue;
    if (file_ < 0) break;
    announce();
    // Another may have taken it for one left behind, before it was locked.
    if (flock(file_, LOCK_EX | LOCK_NB) == 0 ? isAt(file_, temporary_) : errno != EWOULDBLOCK) return 0;
    forgetName();
    close();
    errno = EEXIST;
  }
  temporary_.clear();
  return errno;
}

/// Gives the nameless file a name beside the target. 0, or why it has none.
int FileWriter::nameNameless() {
  for (int number = 0; number < kMostNames; ++number) {
    std::string name = nameBeside(place_, number);
    if (linkat(AT_FDCWD, linkOf(file_).c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
      temporary_ = std::move(name);
      announce();
      return 0;
    }
    if (errno != EEXIST) break;
  }
  return errno;
}

void FileWriter::announce() {
  if (unfinished_ != nullptr) slot_ = unfinished_->announce(temporary_);
}

void FileWriter::forgetName() {
  if (slot_ >= 0) unfinished_->forget(slot_);
  slot_ = -1;
  temporary_.clear();
}

void FileWriter::close() {
  if (file_ >= 0 && ::close(std::exchange(file_, -1)) != 0 && first_error_ == 0) first_error_ = errno;
}

void FileWriter::write(const void* bytes, size_t count) {
  const char* from = static_cast<const char*>(bytes);
  bytes_ += count;
  if (buffer_.size() + count > kBufferBytes) flush();
  if (count > kBufferBytes) {
    send(from, count);
  } else {
    buffer_.insert(buffer_.end(), from, from + count);
  }
}

void FileWriter::flush() {
  send(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void FileWriter::send(const char* from, size_t count) {
  while (first_error_ == 0 && count > 0) {
    const ssize_t sent = ::write(file_, from, count);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) {
      first_error_ = sent < 0 ? errno : EIO;
      return;
    }
    from += sent;
    count -= static_cast<size_t>(sent);
  }
}

Error FileWriter::errorFrom(int code) const { return writeError(target_, code); }

Result<void> FileWriter::finish() {
  if (first_error_ == 0 && file_ >= 0) {
    flush();
    // Some file systems only tell here that they are full.
    if (first_error_ == 0 && fsync(file_) != 0 && errno != EINVAL) first_error_ = errno;
    if (first_error_ == 0 && temporary_.empty()) first_error_ = nameNameless();
  }
  if (first_error_ != 0) return errorFrom(first_error_);
  return {};
}

Result<void> FileWriter::commit() {
  if (Result<void> done = finish(); !done) return done;
  if (std::rename(temporary_.c_str(), place_.c_str()) != 0) return errorFrom(errno);
  forgetName();
  close();
  return {};
}

Result<void> FileWriter::commitReversibly() {
  if (Result<void> done = finish(); !done) return done;
#ifdef RENAME_EXCHANGE
  if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, place_.c_str(), RENAME_EXCHANGE) == 0) {
    undo_ = Undo::exchange;  // what is beside the target now is what it was
    return {};
  }
#endif
  if (access(place_.c_str(), F_OK) != 0) undo_ = Undo::remove;
  return commit();
}

void FileWriter::undo() {
#ifdef RENAME_EXCHANGE
  if (undo_ == Undo::exchange) renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, place_.c_str(), RENAME_EXCHANGE);
#endif
  if (undo_ == Undo::remove) unlink(place_.c_str());
  undo_ = Undo::impossible;
}

}  // namespace sgm

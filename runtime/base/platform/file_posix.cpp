#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/platform/file.h"

namespace sgm::platform {
namespace fs = std::filesystem;
namespace {

/// Repeats a system call until no signal interrupts it (EINTR).
template <class Call>
auto withoutInterruption(const Call& call) {
  for (;;) {
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

void fill(const struct stat& from, FileStatus& to) {
  to.kind = S_ISREG(from.st_mode)   ? FileStatus::Kind::regular
            : S_ISDIR(from.st_mode) ? FileStatus::Kind::folder
            : S_ISLNK(from.st_mode) ? FileStatus::Kind::link
                                    : FileStatus::Kind::other;
  to.bytes = static_cast<uint64_t>(from.st_size);
  to.changed_ns = int64_t{from.st_mtim.tv_sec} * 1'000'000'000 + from.st_mtim.tv_nsec;
  to.device = static_cast<uint64_t>(from.st_dev);
  to.number = static_cast<uint64_t>(from.st_ino);
}

/// Returns a path under /proc that refers to an open file, valid while the file is open.
std::string linkOf(int file) { return "/proc/self/fd/" + std::to_string(file); }

}  // namespace

int openFile(const fs::path& path, unsigned flags) {
  // Without O_NONBLOCK, opening a pipe blocks until another process opens its other end.
  int how = O_CLOEXEC | ((flags & kWait) != 0 ? 0 : O_NONBLOCK);
  how |= (flags & kWrite) == 0 ? O_RDONLY : (flags & kRead) != 0 ? O_RDWR : O_WRONLY;
  if ((flags & kCreate) != 0) how |= O_CREAT;
  if ((flags & kExclusive) != 0) how |= O_EXCL;
  if ((flags & kNoFollow) != 0) how |= O_NOFOLLOW;
  return withoutInterruption([&] { return ::open(path.c_str(), how, 0666); });
}

int openAgain(int file) { return ::open(linkOf(file).c_str(), O_RDONLY | O_CLOEXEC); }

// close() is not repeated after EINTR: on Linux the descriptor is closed even then.
int closeFile(int file) { return ::close(file); }

int statusOf(int file, FileStatus& status) {
  struct stat found {};
  if (::fstat(file, &found) != 0) return -1;
  fill(found, status);
  return 0;
}

int statusAt(const fs::path& path, FileStatus& status, bool follow_links) {
  struct stat found {};
  if ((follow_links ? ::stat(path.c_str(), &found) : ::lstat(path.c_str(), &found)) != 0) return -1;
  fill(found, status);
  return 0;
}

bool isWritable(const fs::path& path) { return ::access(path.c_str(), W_OK) == 0; }

ptrdiff_t readNext(int file, void* to, size_t count) {
  return withoutInterruption([&] { return ::read(file, to, count); });
}

ptrdiff_t writeNext(int file, const void* from, size_t count) {
  return withoutInterruption([&] { return ::write(file, from, count); });
}

ptrdiff_t readAt(int file, void* to, size_t count, uint64_t offset) {
  return withoutInterruption([&] { return ::pread(file, to, count, static_cast<off_t>(offset)); });
}

ptrdiff_t writeAt(int file, const void* from, size_t count, uint64_t offset) {
  return withoutInterruption([&] { return ::pwrite(file, from, count, static_cast<off_t>(offset)); });
}

int syncFile(int file) {
  return withoutInterruption([&] { return ::fsync(file); });
}

int syncContent(int file) {
  return withoutInterruption([&] { return ::fdatasync(file); });
}

int cutFile(int file, uint64_t bytes) {
  return withoutInterruption([&] { return ::ftruncate(file, static_cast<off_t>(bytes)); });
}

int lockFile(int file) {
  return withoutInterruption([&] { return ::flock(file, LOCK_EX | LOCK_NB); });
}

int replaceFile(const fs::path& from, const fs::path& to) { return std::rename(from.c_str(), to.c_str()); }

int exchangeFiles([[maybe_unused]] const fs::path& a, [[maybe_unused]] const fs::path& b) {
#ifdef RENAME_EXCHANGE
  return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE);
#else
  errno = ENOTSUP;
  return -1;
#endif
}

int removeFile(const fs::path& path) { return ::unlink(path.c_str()); }

void removeFileInHandler(const char* name) noexcept { ::unlink(name); }

int touchFile(const fs::path& path) { return ::utimensat(AT_FDCWD, path.c_str(), nullptr, AT_SYMLINK_NOFOLLOW); }

int openNamelessFile([[maybe_unused]] const fs::path& folder) {
#ifdef O_TMPFILE
  const int file = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  // nameFile() will link the file through /proc, which some containers do not have. Without /proc, fail already here,
  // with ENOTSUP.
  if (file < 0 || ::access(linkOf(file).c_str(), F_OK) == 0) return file;
  ::close(file);
#endif
  errno = ENOTSUP;
  return -1;
}

int openScratchFile(const fs::path& folder) {
#ifdef O_TMPFILE
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC | O_EXCL, 0400);
  // If O_TMPFILE has failed, creates a named file and removes its name at once. If the folder is the cause (it is
  // missing or not writable), this fails, too.
  if (file >= 0) return file;
#endif
  std::string name = (folder / "sgm_scratch_XXXXXX").string();
  File named(::mkostemp(name.data(), O_CLOEXEC));
  if (!named) return -1;
  ::unlink(name.c_str());
  return ::fchmod(named.number(), 0400) == 0 ? named.release() : -1;
}

int nameFile(int file, const fs::path& name) {
  return ::linkat(AT_FDCWD, linkOf(file).c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
}

int takeRights(int file, const fs::path& from) {
  struct stat of {};
  if (::stat(from.c_str(), &of) != 0) return -1;
  // Changing the owner may fail, for lack of permission; copying the mode is useful even then.
  if ((of.st_uid != ::geteuid() || of.st_gid != ::getegid()) && ::fchown(file, of.st_uid, of.st_gid) != 0) errno = 0;
  return ::fchmod(file, of.st_mode & 0777);
}

int makeFolder(const fs::path& path) { return ::mkdir(path.c_str(), 0777); }

int syncFolder(const fs::path& path) {
  const File folder(::open(path.empty() ? "." : path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder) return -1;
  return syncFile(folder.number()) == 0 || errno == EINVAL ? 0 : -1;
}

}  // namespace sgm::platform

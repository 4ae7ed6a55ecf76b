#pragma once
// Files as the operating system has them: locks, positions, durability and identity, which std::filesystem and <cstdio>
// lack. Each system has one source file that implements this header.
//
// A file is a descriptor. Functions that return int or ptrdiff_t return -1 if they fail, with the reason in errno, and
// 0 (or the number of bytes) otherwise; no call returns early because of a signal. Thread-safe.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>

namespace sgm::platform {

struct FileStatus {
  enum class Kind { regular, folder, link, other };
  Kind kind = Kind::other;
  uint64_t bytes = 0;
  int64_t changed_ns = 0;  ///< time of the last change of its content, nanoseconds since 1970
  uint64_t device = 0, number = 0;

  bool isRegular() const { return kind == Kind::regular; }
  bool isSameFile(const FileStatus& other) const { return device == other.device && number == other.number; }
};

enum OpenFlag : unsigned {
  kRead = 1,
  kWrite = 2,
  kCreate = 4,     ///< create the file if it is missing
  kExclusive = 8,  ///< with kCreate: fail with EEXIST if it is there
  kNoFollow = 16,  ///< fail with ELOOP if the path is a symbolic link
  kWait = 32,      ///< wait for a pipe's other end, and when it is read, for its bytes
};

/// Opens a file. flags: OpenFlags. Without kWait the call never waits; child processes do not inherit the file.
int openFile(const std::filesystem::path& path, unsigned flags);
/// Opens the same file once more, for reading, at its beginning.
int openAgain(int file);
int closeFile(int file);

int statusOf(int file, FileStatus& status);
int statusAt(const std::filesystem::path& path, FileStatus& status, bool follow_links);
/// Whether this process may write to the file at the path; errno says why not.
bool isWritable(const std::filesystem::path& path);

/// At the file's position, which moves on. May transfer fewer bytes than `count`; 0: the file has ended.
ptrdiff_t readNext(int file, void* to, size_t count);
ptrdiff_t writeNext(int file, const void* from, size_t count);
/// At an offset from the beginning; the file's position stays.
ptrdiff_t readAt(int file, void* to, size_t count, uint64_t offset);
ptrdiff_t writeAt(int file, const void* from, size_t count, uint64_t offset);
/// Returns when the disk has the file's content. EINVAL if the file system cannot tell.
int syncFile(int file);
/// As syncFile, but times of access and change may be missing from the disk.
int syncContent(int file);
/// Cuts the file off after `bytes`.
int cutFile(int file, uint64_t bytes);
/// Locks the file exclusively, against other processes and other openings in this one, until it is closed. Readers are
/// not kept out. -1 with EWOULDBLOCK if another has the lock.
int lockFile(int file);

/// Gives a file another name, and replaces the file that has this name in one step.
int replaceFile(const std::filesystem::path& from, const std::filesystem::path& to);
/// Exchanges the names of two files in one step. ENOTSUP if the file system cannot.
int exchangeFiles(const std::filesystem::path& a, const std::filesystem::path& b);
int removeFile(const std::filesystem::path& path);
/// For a signal's handler: neither locks nor allocates. name: UTF-8, ends with 0.
void removeFileInHandler(const char* name) noexcept;
/// Sets the time of the last change to now. Does not follow links.
int touchFile(const std::filesystem::path& path);

/// A file in the folder that has no name yet, for writing. ENOTSUP if the system or the file system has no such files.
int openNamelessFile(const std::filesystem::path& folder);
/// A file in the folder that never has a name, for reading and writing; the system deletes it when it is closed.
/// openAgain() may read it, and nobody may open it for writing.
int openScratchFile(const std::filesystem::path& folder);
/// Gives a file of openNamelessFile() its name. EEXIST if another file has it.
int nameFile(int file, const std::filesystem::path& name);
/// Gives the file the mode, and if this process may the owner, of the file at the path.
int takeRights(int file, const std::filesystem::path& from);

/// Creates a folder; EEXIST if there is something of that name.
int makeFolder(const std::filesystem::path& path);
/// Returns when the disk has the folder's names. 0 if its file system has nothing to do.
int syncFolder(const std::filesystem::path& path);

/// Owns a descriptor, or none (-1).
class File {
 public:
  File() = default;
  explicit File(int number) : number_(number) {}
  File(File&& other) noexcept : number_(other.release()) {}
  File& operator=(File&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~File() {
    if (number_ >= 0) closeFile(number_);
  }

  explicit operator bool() const { return number_ >= 0; }
  int number() const { return number_; }
  int release() { return std::exchange(number_, -1); }

 private:
  int number_ = -1;
};

}  // namespace sgm::platform

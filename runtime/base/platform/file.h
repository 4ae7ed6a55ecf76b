#pragma once
// File functions of the operating system that std::filesystem and <cstdio> lack: locks, reads at an offset,
// synchronisation to disk, file identity. Each operating system has one source file that implements this header. A file
// is represented by its descriptor. Functions that return int or ptrdiff_t return -1 on failure, with the reason in
// errno; on success 0, a descriptor, or the number of bytes. Calls interrupted by a signal are repeated. Thread-safe.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>

namespace sgm::platform {

struct FileStatus {
  enum class Kind { regular, folder, link, other };
  Kind kind = Kind::other;
  uint64_t bytes = 0;
  int64_t changed_ns = 0;  ///< last modification time of the content, in nanoseconds since 1970
  uint64_t device = 0, number = 0;

  bool isRegular() const { return kind == Kind::regular; }
  bool isSameFile(const FileStatus& other) const { return device == other.device && number == other.number; }
};

enum OpenFlag : unsigned {
  kRead = 1,
  kWrite = 2,
  kCreate = 4,     ///< create the file if it is missing
  kExclusive = 8,  ///< together with kCreate: fail with EEXIST if the file exists
  kNoFollow = 16,  ///< fail with ELOOP if the path is a symbolic link
  kWait = 32,      ///< if the file is a pipe: openFile() waits until another process opens the other end, and later
                   ///< reads wait for bytes
};

/// Opens a file and returns its descriptor. flags: OpenFlag values combined by |. Without kWait the call never blocks.
/// Child processes do not inherit the descriptor.
int openFile(const std::filesystem::path& path, unsigned flags);
/// Returns a new descriptor of the same file, open for reading, at offset 0.
int openAgain(int file);
int closeFile(int file);

int statusOf(int file, FileStatus& status);
int statusAt(const std::filesystem::path& path, FileStatus& status, bool follow_links);
/// Returns true if this process may write to the file at the path; otherwise false, with the reason in errno.
bool isWritable(const std::filesystem::path& path);

/// Read from or write to the file's current position, and advance the position. May transfer fewer bytes than `count`;
/// reading returns 0 at the end of the file.
ptrdiff_t readNext(int file, void* to, size_t count);
ptrdiff_t writeNext(int file, const void* from, size_t count);
/// Read from or write to the given offset, without using or changing the file's current position.
ptrdiff_t readAt(int file, void* to, size_t count, uint64_t offset);
ptrdiff_t writeAt(int file, const void* from, size_t count, uint64_t offset);
/// Blocks until the file's content and metadata are on disk (fsync). EINVAL if the file system does not support this.
int syncFile(int file);
/// Like syncFile(), but may leave access and modification times unwritten.
int syncContent(int file);
/// Truncates the file to `bytes` bytes.
int cutFile(int file, uint64_t bytes);
/// Tries to acquire an exclusive advisory lock without blocking; the lock lasts until the file is closed. It excludes
/// other processes and other descriptors of this process, but does not prevent reading. Returns -1 with EWOULDBLOCK if
/// the file is already locked.
int lockFile(int file);

/// Renames a file atomically, replacing any file that already has the new name.
int replaceFile(const std::filesystem::path& from, const std::filesystem::path& to);
/// Exchanges the names of two files atomically. ENOTSUP if the file system does not support this.
int exchangeFiles(const std::filesystem::path& a, const std::filesystem::path& b);
int removeFile(const std::filesystem::path& path);
/// Removes a file. Safe in a signal handler: neither locks nor allocates. name: UTF-8, null-terminated.
void removeFileInHandler(const char* name) noexcept;
/// Sets the file's modification time to the current time. Does not follow symbolic links.
int touchFile(const std::filesystem::path& path);

/// Creates a file without a name in the folder, open for writing; nameFile() gives it a name. ENOTSUP if the file
/// system or the operating system does not support such files.
int openNamelessFile(const std::filesystem::path& folder);
/// Creates a temporary file without a name in the folder, open for reading and writing; the system deletes it when it
/// is closed. Only openAgain() can open it a second time.
int openScratchFile(const std::filesystem::path& folder);
/// Gives a name to a file created by openNamelessFile(). EEXIST if a file with this name exists.
int nameFile(int file, const std::filesystem::path& name);
/// Copies the access mode from the file at the path to the open file, and also the owner if this process is permitted
/// to.
int takeRights(int file, const std::filesystem::path& from);

/// Creates a folder; EEXIST if the name is already in use.
int makeFolder(const std::filesystem::path& path);
/// Blocks until the folder's entries are on disk. Returns 0 also if the file system does not support this.
int syncFolder(const std::filesystem::path& path);

/// Owns a file descriptor and closes it in the destructor; -1 means none.
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

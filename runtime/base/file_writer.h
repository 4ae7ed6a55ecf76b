#pragma once
// Writes output files atomically: a file appears completely or not at all.

#include <array>
#include <atomic>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sgm {

/// The names of unfinished files, so that a signal handler can remove the files. The handler may run between any two
/// instructions of the threads that write: names are therefore never freed, and a name is valid only once it is fully
/// copied. There are 8 slots; if all are in use, a further file is written, but not registered. Must outlive all
/// FileWriters that use it. Thread-safe.
class UnfinishedFiles {
 public:
  /// Removes all registered files. Safe in a signal handler: neither locks nor allocates.
  void remove() const noexcept;

 private:
  friend class FileWriter;
  /// Registers the name of an unfinished file for removal by the signal handler. Returns the number of its slot, or -1
  /// if all slots are in use or the name is too long.
  int announce(const std::string& name);
  void forget(int slot) { slots_[static_cast<size_t>(slot)].state = Slot::open; }

  struct Slot {
    enum State { open, filling, whole };
    std::atomic<int> state{open};
    std::array<char, 4096> name{};
  };
  std::array<Slot, 8> slots_{};
};

/// Writes a temporary file, which commit() renames to its target. After any failure, or without commit, the temporary
/// file is removed and the target is unchanged. If the target is a symbolic link, the file that it refers to is
/// replaced; a replaced file's mode is kept. The first error is stored, and commit() returns it. Not thread-safe.
///
/// If the file system supports O_TMPFILE, the temporary file has no name until commit, so that even a killed process
/// leaves no file. Otherwise its name is TARGET.sgm-partN, in the target's folder, and its writer locks it. An unlocked
/// file of that name is the leftover of a killed process; the next FileWriter for that target removes it.
class FileWriter {
 public:
  enum class Naming {
    nameless,  ///< the temporary file has no name before finish() or commit(), if the file system supports that
    named,     ///< the temporary file has a name in the target's folder from the beginning
  };

  /// unfinished: registers the temporary file while it has a name; may be null. Error: Code::io if the folder is
  /// missing or not writable, or the target is write-protected or not a regular file.
  static Result<FileWriter> create(const std::filesystem::path& target, UnfinishedFiles* unfinished = nullptr,
                                   Naming naming = Naming::nameless);

  FileWriter(FileWriter&& other) noexcept;
  FileWriter& operator=(FileWriter&&) = delete;
  ~FileWriter();

  void write(const void* bytes, size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Writes a number of an arithmetic type T, little-endian on every supported machine.
  template <class T>
  void writeValue(T value) {
    write(&value, sizeof value);
  }

  /// Writes everything to the disk and gives the temporary file a name, but leaves the target unchanged. Error:
  /// Code::io, for instance if the disk is full.
  Result<void> finish();
  /// Calls finish(), then renames the temporary file to the target.
  Result<void> commit();
  /// Same as commit(), but undo() can restore the previous target until this object is destroyed, if the file system
  /// can exchange two names. Used to replace several files together or not at all.
  Result<void> commitReversibly();
  void undo();

  uint64_t bytes() const { return bytes_; }  ///< number of bytes passed to write() so far
  /// The path of the temporary file, for callers that let another program fill it. Empty while the file has no name.
  const std::string& name() const { return temporary_; }

 private:
  enum class Undo { impossible, exchange, remove };

  FileWriter(std::filesystem::path target, std::string place, int file, UnfinishedFiles* unfinished);
  void announce();
  int openNamed();
  int nameNameless();
  void forgetName();
  void close();
  void flush();
  void send(const char* from, size_t count);
  Error errorFrom(int code) const;

  std::filesystem::path target_;  // the target's path as given by the caller
  std::string place_;             // the target's path with symbolic links resolved
  std::string temporary_;         // the path of the temporary file in the target's folder; empty while the file has no
                                  // name
  int file_ = -1;
  UnfinishedFiles* unfinished_;
  int slot_ = -1;  // index of this file's slot in unfinished_; -1 if the file is not registered
  std::vector<char> buffer_;
  uint64_t bytes_ = 0;
  int first_error_ = 0;  // errno of the first failure
  Undo undo_ = Undo::impossible;
};

}  // namespace sgm

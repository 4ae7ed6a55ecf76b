#pragma once
// Writes output files that appear completely or not at all.

#include <array>
#include <atomic>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sgm {

/// The names of unfinished files, so that a signal handler can remove the files. The handler may run between any two
/// instructions of the writers: names are therefore never freed, and a name is valid only once it is fully copied.
/// There are 8 slots; if all are in use, a further file is written, but not registered. Must outlive the writers that
/// use it. Thread-safe.
class UnfinishedFiles {
 public:
  /// Removes all registered files. Neither locks nor allocates.
  void remove() const noexcept;

 private:
  friend class FileWriter;
  /// Returns the number of the slot, or -1 if all slots are in use or the name is too long.
  int announce(const std::string& name);
  void forget(int slot) { slots_[static_cast<size_t>(slot)].state = Slot::open; }

  struct Slot {
    enum State { open, filling, whole };
    std::atomic<int> state{open};
    std::array<char, 4096> name{};
  };
  std::array<Slot, 8> slots_{};
};

/// Writes a file that gets the name of its target on commit. After any failure, or without commit, no file is left
/// behind and the target is unchanged. A target that is a symbolic link stays one, and a replaced file keeps its mode.
/// The first error is kept, and commit returns it. Not thread-safe.
///
/// Until commit the file has no name if the file system supports that (O_TMPFILE), so that even a killed process leaves
/// no file. Otherwise it is TARGET.sgm-partN beside the target, locked by its writer. If such a file is not locked, a
/// killed process left it, and the next writer of that target removes it.
class FileWriter {
 public:
  enum class Naming {
    nameless,  ///< no name before finish or commit, if the file system supports that
    named,     ///< a name beside the target from the beginning
  };

  /// unfinished: lists the file while its name differs from the target's; may be null.
  /// Error: Code::io if the folder is missing or not writable, or the target is write-protected or not a regular file.
  static Result<FileWriter> create(const std::filesystem::path& target, UnfinishedFiles* unfinished = nullptr,
                                   Naming naming = Naming::nameless);

  FileWriter(FileWriter&& other) noexcept;
  FileWriter& operator=(FileWriter&&) = delete;
  ~FileWriter();

  void write(const void* bytes, size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Little-endian on every supported machine; T is an arithmetic type.
  template <class T>
  void writeValue(T value) {
    write(&value, sizeof value);
  }

  /// Flushes everything to the disk, into a file beside the target with a name of its own. Error: Code::io, for
  /// instance if the disk is full.
  Result<void> finish();
  /// Calls finish, then renames the file to the target.
  Result<void> commit();
  /// Does the same as commit, but keeps the replaced file until the destructor runs, so that undo can restore it if the
  /// file system can exchange two names. Used if several files must be replaced together or not at all.
  Result<void> commitReversibly();
  void undo();

  uint64_t bytes() const { return bytes_; }  ///< bytes passed to write so far
  /// The path of the unfinished file, so that another program can fill it; empty while it has no name.
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

  std::filesystem::path target_;  // as given by the caller
  std::string place_;             // the target with symbolic links resolved
  std::string temporary_;         // the path of the unfinished file beside the target; empty while it has no name
  int file_ = -1;
  UnfinishedFiles* unfinished_;
  int slot_ = -1;  // index of this file's slot in unfinished_; -1 if the file is not registered
  std::vector<char> buffer_;
  uint64_t bytes_ = 0;
  int first_error_ = 0;  // errno of the first failure
  Undo undo_ = Undo::impossible;
};

}  // namespace sgm

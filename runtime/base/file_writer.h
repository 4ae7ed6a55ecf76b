#pragma once
// Output files that appear whole or not at all.

#include <array>
#include <atomic>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sgm {

/// The names of unfinished files, for a program that a signal may end. It runs its handler between any two instructions
/// of ours, so a name is never freed, and counts from when it is whole. There is room for a few; a writer that finds
/// none is not known here, and no worse off otherwise. Must outlive the writers that it is given to. Any thread.
class UnfinishedFiles {
 public:
  /// Removes them all. Neither locks nor allocates.
  void remove() const noexcept;

 private:
  friend class FileWriter;
  /// A slot's number, -1 where there is no room.
  int announce(const std::string& name);
  void forget(int slot) { slots_[static_cast<size_t>(slot)].state = Slot::open; }

  struct Slot {
    enum State { open, filling, whole };
    std::atomic<int> state{open};
    std::array<char, 4096> name{};
  };
  std::array<Slot, 8> slots_{};
};

/// Writes a file that takes its target's name on commit. Whatever fails, and without commit, nothing is left behind and
/// the target is as it was. A target that is a link stays one, and one that is replaced keeps its mode. The first error
/// is kept and comes out of commit. One thread.
///
/// Until commit the file has no name where the file system can do that (O_TMPFILE), so that not even a killed process
/// leaves it; elsewhere it stands beside the target as TARGET.sgm-partN, locked by its writer: one that nobody holds
/// was left by a killed process, and the next writer of that target removes it.
class FileWriter {
 public:
  enum class Naming {
    nameless,  ///< no name before commit, where the file system can
    named,     ///< a name beside the target from the beginning
  };

  /// unfinished: told of the file while it has a name that is not its target's; or null.
  /// Error: Code::io, where the folder is missing or not writable, or the target is no regular file or write-protected.
  static Result<FileWriter> create(const std::filesystem::path& target, UnfinishedFiles* unfinished = nullptr,
                                   Naming naming = Naming::nameless);

  FileWriter(FileWriter&& other) noexcept;
  FileWriter& operator=(FileWriter&&) = delete;
  ~FileWriter();

  void write(const void* bytes, size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Little-endian on every machine we build for; T is an arithmetic type.
  template <class T>
  void writeValue(T value) {
    write(&value, sizeof value);
  }

  /// Everything handed to the disk, beside the target under a name of its own. Error: Code::io, for instance when the
  /// disk is full.
  Result<void> finish();
  /// finish, then the target's name.
  Result<void> commit();
  /// As commit, and what stood at the target is kept until the destructor, so that undo can bring it back where the
  /// file system can exchange two names: for files that belong together.
  Result<void> commitReversibly();
  void undo();

  uint64_t bytes() const { return bytes_; }  ///< handed to write so far
  /// Where the unfinished file stands, for another program to fill it; empty while it has no name.
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

  std::filesystem::path target_;  // as the caller calls it
  std::string place_;             // where it is, links followed
  std::string temporary_;         // beside it; empty while it has no name
  int file_ = -1;
  UnfinishedFiles* unfinished_;
  int slot_ = -1;  // in unfinished_
  std::vector<char> buffer_;
  uint64_t bytes_ = 0;
  int first_error_ = 0;  // errno of the first failure
  Undo undo_ = Undo::impossible;
};

}  // namespace sgm

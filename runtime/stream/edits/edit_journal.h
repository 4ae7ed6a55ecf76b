#pragma once
// The edits of a world on disk: a head that identifies the world, then operations with their lengths and checksums.

#include <filesystem>
#include <memory>
#include <mutex>

#include "world/edit_operation.h"

namespace sgm {

/// Identifies the world of a journal.
struct WorldIdentity {
  uint64_t grammar = 0;  ///< hash of the grammar and its parameters
  uint64_t seed = 0;
  int32_t cell = 0;  ///< edge of the finest cell in units
};

struct OpenedJournal;

/// Thread-safe. Everything that was flushed is there when the file is opened again, even after a crash of the process
/// or a power failure. The file is locked during the journal's lifetime, so that no other process opens it.
class EditJournal {
 public:
  /// Opens or creates the file. A damaged file is kept under another name, and its content before the damage continues
  /// in a new one. A file in which most operations are no longer essential (essentialEdits) is rewritten without them.
  /// io: not readable or writable, or no room. bad_input: not a journal, or of another version or world; the file stays
  /// as it is. limit: the file is already open, or larger than a gigabyte.
  static Result<OpenedJournal> open(const std::filesystem::path& path, const WorldIdentity& world);

  EditJournal(const EditJournal&) = delete;
  EditJournal& operator=(const EditJournal&) = delete;
  ~EditJournal();  ///< flushes; to see errors, call flush() before

  /// Stores operations in memory; never waits for the disk. Throws std::bad_alloc, and then stores none.
  void append(std::span<const EditOperation> operations);
  /// Writes the appended operations, and blocks until they are on disk. Call it every second on a thread other than the
  /// frame's; then at most that second can be lost. io: nothing is lost, and the next call tries again; the message
  /// says how many operations are not on disk.
  Result<void> flush();

 private:
  EditJournal(std::filesystem::path path, int file, uint64_t size) : path_(std::move(path)), file_(file), size_(size) {}

  const std::filesystem::path path_;
  const int file_;
  std::mutex appending_, writing_;
  std::vector<std::byte> waiting_;    ///< guarded by appending_
  std::vector<std::byte> unwritten_;  ///< guarded by writing_
  uint64_t size_;                     ///< the size of the file on disk; guarded by writing_
};

struct OpenedJournal {
  std::unique_ptr<EditJournal> journal;
  std::vector<EditOperation> operations;  ///< in the order of writing
  uint64_t cut_bytes = 0;                 ///< lost: of a last operation that was not completely written
  size_t left_out = 0;                    ///< removed: operations that were no longer essential
  std::filesystem::path damaged;          ///< path of the damaged file; empty: the file was intact
  std::string message;                    ///< for the log, if something was wrong
};

}  // namespace sgm

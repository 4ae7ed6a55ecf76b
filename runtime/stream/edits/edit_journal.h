#pragma once
// A file with the edits of a world: a head that identifies the world, then operations, each with its length and
// checksum.

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>

#include "world/edit_operation.h"

namespace sgm {

/// Identifies the world to which a journal belongs.
struct WorldIdentity {
  uint64_t grammar = 0;  ///< hash of the grammar and its parameters
  uint64_t seed = 0;
  int32_t cell = 0;  ///< edge of the finest cell in units
};

/// Returns the hash of the grammar that version 0.2 wrote as WorldIdentity::grammar. A call may take milliseconds.
using FormerGrammar = std::function<uint64_t()>;

struct OpenedJournal;

/// Thread-safe. All operations that were flushed are read when the file is opened again, even after a crash of the
/// process or a power failure. The file is locked during the journal's lifetime, so that no other process opens it.
class EditJournal {
 public:
  /// Opens or creates the file. If the file is damaged, it is renamed, and a new file continues with the content before
  /// the damage. If most operations are no longer essential (essentialEdits), the file is rewritten without them.
  /// former: called only if the file's hash of the grammar is not `world.grammar`; its result is accepted as well, and
  /// the file keeps that hash until it is rewritten. May be null.
  /// Errors: io if the file cannot be read or written, or the disk is full; bad_input if it is not a journal, or is of
  /// another version or world (the file is not changed); limit if the file is already open, or larger than a gigabyte.
  static Result<OpenedJournal> open(const std::filesystem::path& path, const WorldIdentity& world,
                                    const FormerGrammar& former = {});

  EditJournal(const EditJournal&) = delete;
  EditJournal& operator=(const EditJournal&) = delete;
  ~EditJournal();  ///< Flushes, but cannot report errors: call flush() before.

  /// Adds operations to a buffer in memory; never waits for the disk. Throws std::bad_alloc, and then adds none.
  void append(std::span<const EditOperation> operations);
  /// Writes the appended operations, and blocks until they are on disk. If it is called every second, on a thread other
  /// than the frame's, a crash loses at most one second. Error: io; no operation is lost then, the next call tries
  /// again, and the message says how many operations are not on disk.
  Result<void> flush();

 private:
  EditJournal(std::filesystem::path path, int file, uint64_t size) : path_(std::move(path)), file_(file), size_(size) {}

  const std::filesystem::path path_;
  const int file_;
  std::mutex appending_, writing_;
  std::vector<std::byte> waiting_;    ///< appended operations; guarded by appending_
  std::vector<std::byte> unwritten_;  ///< operations that are being written; guarded by writing_
  uint64_t size_;                     ///< size of the file on disk; guarded by writing_
};

struct OpenedJournal {
  std::unique_ptr<EditJournal> journal;
  std::vector<EditOperation> operations;  ///< the file's operations, in the order of writing
  uint64_t cut_bytes = 0;                 ///< size of an incompletely written last operation, which was lost
  size_t left_out = 0;                    ///< number of operations removed, because they were no longer essential
  std::filesystem::path damaged;          ///< new path of the damaged file; empty: the file was intact
  std::string message;                    ///< message for the log, if the file had a problem; otherwise empty
};

}  // namespace sgm

#pragma once
// A file that stores the edits of a world: a header that identifies the world, then operations, each with its length
// and checksum.

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>

#include "world/edit_operation.h"

namespace sgm {

/// Identifies the world to which a journal belongs.
struct WorldIdentity {
  uint64_t grammar = 0;  ///< hash of the grammar and of its parameters
  uint64_t seed = 0;
  int32_t cell = 0;  ///< cell edge at level 0, in units
};

/// Returns the grammar hash that version 0.2 of the library stored in WorldIdentity::grammar. A call may take
/// milliseconds.
using FormerGrammar = std::function<uint64_t()>;

struct OpenedJournal;

/// A journal of edits that survives crashes: all operations that were flushed are read when the file is opened again,
/// even after a crash of the process or a power failure. The file is locked during the journal's lifetime, so that no
/// other process can open it. Thread-safe.
class EditJournal {
 public:
  /// Opens or creates the file. A damaged file is copied to another name, and the journal continues with the content
  /// before the damage. If most operations are superseded (essentialEdits), the file is rewritten without them. former:
  /// returns the grammar hash that version 0.2 of the library stored; may be null. It is called only if the file's
  /// grammar hash differs from `world.grammar`. If the file's hash equals the result, the file is accepted too, and
  /// keeps this hash until it is rewritten. Errors: io if the file cannot be read or written, or the disk is full;
  /// bad_input if it is not a journal, or is of another version or world (the file is not changed); limit if the file
  /// is already open elsewhere, or larger than a gigabyte.
  static Result<OpenedJournal> open(const std::filesystem::path& path, const WorldIdentity& world,
                                    const FormerGrammar& former = {});

  EditJournal(const EditJournal&) = delete;
  EditJournal& operator=(const EditJournal&) = delete;
  ~EditJournal();  ///< Flushes the journal. Cannot report errors, so call flush() before.

  /// Adds operations to a buffer in memory; never waits for the disk. If it throws std::bad_alloc, none is added.
  void append(std::span<const EditOperation> operations);
  /// Writes the appended operations, and blocks until they are on disk. Call it every second on a thread other than the
  /// rendering thread: then a crash loses at most one second of edits. Error: io. In this case no operation is lost,
  /// the next call tries again, and the message says how many operations are not on disk.
  Result<void> flush();

 private:
  EditJournal(std::filesystem::path path, int file, uint64_t size) : path_(std::move(path)), file_(file), size_(size) {}

  const std::filesystem::path path_;
  const int file_;
  std::mutex appending_, writing_;
  /// encoded operations that append() has added and flush() has not taken yet; guarded by appending_
  std::vector<std::byte> waiting_;
  /// encoded operations that flush() has taken and that are not all on disk yet; guarded by writing_
  std::vector<std::byte> unwritten_;
  uint64_t size_;  ///< size of the file on disk; guarded by writing_
};

struct OpenedJournal {
  std::unique_ptr<EditJournal> journal;
  std::vector<EditOperation> operations;  ///< the file's operations, in the order of writing
  uint64_t cut_bytes = 0;                 ///< size in bytes of an incomplete last operation, which was discarded
  size_t left_out = 0;                    ///< number of superseded operations that were removed
  std::filesystem::path damaged;          ///< path of the copy of the damaged file; empty if the file was intact
  std::string message;                    ///< message for the log, if the file had a problem; otherwise empty
};

}  // namespace sgm
